/// What sensors beside the camera told when a photo was taken.
package struct SensorReading: Hashable, Codable, Sendable {
  /// The direction of gravity in the frame of the camera: x right, y down, z forward, of the upright
  /// photo.
  package var gravity: SIMD3<Double>?
  package var depth: DepthMap?

  package init(gravity: SIMD3<Double>? = nil, depth: DepthMap? = nil) {
    self.gravity = gravity
    self.depth = depth
  }
}

/// How far away is what a photo shows, along the optical axis, in metres; its field of view is that of
/// the upright photo, its resolution its own.
package struct DepthMap: Hashable, Codable, Sendable {
  package let width: Int
  package let height: Int
  /// Row by row from the top; what is not positive and finite is unknown.
  package let depths: [Float]

  /// Nil unless there is a depth for each pixel.
  package init?(width: Int, height: Int, depths: [Float]) {
    guard width > 0, height > 0, depths.count == width * height else { return nil }
    self.width = width
    self.height = height
    self.depths = depths
  }

  /// The depth at a place from (0, 0), the photo's top-left corner, to (1, 1); nil outside, where it
  /// is unknown, and at edges, where a pixel of the map stands for near and far.
  package func depth(at place: SIMD2<Double>) -> Double? {
    guard place.x >= 0, place.x < 1, place.y >= 0, place.y < 1 else { return nil }
    let column = Int(place.x * Double(width))
    let row = Int(place.y * Double(height))
    let center = depths[row * width + column]
    guard center > 0, center.isFinite else { return nil }
    for y in max(0, row - 1)...min(height - 1, row + 1) {
      for x in max(0, column - 1)...min(width - 1, column + 1) {
        // Unknown neighbours are signs of an edge, too.
        let isClose = abs(depths[y * width + x] - center) <= Self.edge * center
        if !isClose { return nil }
      }
    }
    return Double(center)
  }

  /// Relative difference of neighbours across an edge.
  private static let edge: Float = 0.05
}
