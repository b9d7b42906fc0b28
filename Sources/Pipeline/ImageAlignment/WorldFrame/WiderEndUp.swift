import SceneModel

/// Decides which of two opposite directions is up, where cameras don't determine it: an object
/// stands on its wider end.
struct WiderEndUp: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Share of the height that is an end. Chosen.
    var endShare = 0.1
    /// Share of the points that are ignored as outliers, at each end. Chosen.
    var outlierShare = 0.01
    /// Minimum ratio of the ends' areas at which the wider one is the lower one. Chosen.
    var minimumRatio = 2.0
    /// Minimum number of points of an end. Chosen.
    var minimumPoints = 10
  }

  var options = Options()

  /// Whether the object, given by its points, stands upside down if `up` is up. False if its ends
  /// are about equally wide.
  func isUpsideDown(_ points: [SIMD3<Double>], up: SIMD3<Double>) -> Bool {
    let heights = points.map { $0.dot(up) }
    guard let low = heights.quantile(options.outlierShare),
      let high = heights.quantile(1 - options.outlierShare), high > low
    else { return false }
    let margin = options.endShare * (high - low)
    func endArea(_ isIncluded: (Double) -> Bool) -> Double? {
      let end = zip(points, heights).filter { isIncluded($0.1) }.map(\.0)
      return end.count >= options.minimumPoints ? area(of: end, up: up) : nil
    }
    guard let bottom = endArea({ $0 >= low && $0 < low + margin }),
      let top = endArea({ $0 <= high && $0 > high - margin })
    else { return false }
    return top > options.minimumRatio * bottom
  }

  /// The area that points cover as seen along `up`: the product of their standard deviations along
  /// the principal axes.
  private func area(of points: [SIMD3<Double>], up: SIMD3<Double>) -> Double {
    let flat = points.map { $0 - $0.dot(up) * up }
    let mean = flat.reduce(.zero, +) / Double(flat.count)
    let values = Matrix3(scatterOf: flat, about: mean).symmetricEigen.values
    return (max(0, values[1]) * max(0, values[2])).squareRoot()
  }
}
