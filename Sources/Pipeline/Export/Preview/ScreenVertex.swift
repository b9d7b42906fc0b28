/// A projected vertex in fixed-point coordinates.
struct ScreenVertex: Hashable, Sendable {
  /// Fixed-point units per sample. Chosen: coverage is exact for integers.
  static let subdivision = 256.0
  /// The same as an integer, and its number of bits. Chosen: as above.
  static let units: Int64 = 256
  static let unitBits = 8
  /// The center of a sample in these units. Limit: half of a sample.
  static let center: Int64 = 128

  /// In fixed-point units from the top-left corner of the picture.
  var x: Int32
  var y: Int32
  /// 1 / z in the camera frame; linear in the picture.
  var inverseDepth: Float
}
