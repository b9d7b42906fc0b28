/// The views that color each corner of a triangle, with their weights.
struct CornerWeights: Sendable {
  struct Share: Hashable, Sendable {
    /// −1 stands for the color interpolated where no photo sees the surface.
    var view: Int32
    var weight: Float
  }

  /// Shares of corner i: `shares[offsets[i]..<offsets[i + 1]]`, ascending by view; they sum to 1.
  var offsets: [Int32] = [0]
  var shares: [Share] = []

  /// `corner` is three times the triangle plus 0, 1 or 2.
  func shares(of corner: Int) -> ArraySlice<Share> {
    shares[Int(offsets[corner])..<Int(offsets[corner + 1])]
  }
}
