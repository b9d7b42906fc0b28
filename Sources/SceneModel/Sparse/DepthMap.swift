/// Depths along the optical axis in meters; the field of view is that of the upright photo, the
/// resolution is independent of it.
package struct DepthMap: Hashable, Codable, Sendable {
  package private(set) var width: Int
  package private(set) var height: Int
  /// Depths row by row from the top; 0 where they are unknown.
  package private(set) var depths: [Float]
  /// Whether the values may be disparities in 1/meter instead of depths; files don't specify this.
  package var mayBeDisparities = false

  /// Relative difference between neighbors that indicates a depth edge. Chosen.
  private static let edge: Float = 0.05

  /// Depths that are not positive and finite are unknown. Nil unless there is one depth per pixel.
  package init?(width: Int, height: Int, depths: [Float]) {
    guard width > 0, height > 0, depths.count == width * height else { return nil }
    self.width = width
    self.height = height
    // Other values have no JSON, in which processes pass maps on.
    self.depths = depths.map { $0 > 0 && $0.isFinite ? $0 : 0 }
  }

  /// The depth at a position from (0, 0), the photo's top-left corner, to (1, 1); nil outside,
  /// where it is unknown, and at depth edges, where one pixel of the map covers both foreground and
  /// background.
  package func depth(at position: SIMD2<Double>) -> Double? {
    guard position.x >= 0, position.x < 1, position.y >= 0, position.y < 1 else { return nil }
    let column = Int(position.x * Double(width))
    let row = Int(position.y * Double(height))
    let center = depths[row * width + column]
    guard center > 0 else { return nil }
    for y in max(0, row - 1)...min(height - 1, row + 1) {
      for x in max(0, column - 1)...min(width - 1, column + 1) {
        // Unknown neighbors also indicate an edge.
        let isClose = abs(depths[y * width + x] - center) <= Self.edge * center
        if !isClose { return nil }
      }
    }
    return Double(center)
  }

  /// The map rotated by an EXIF orientation, 1…8.
  package func turned(byOrientation orientation: Int) -> DepthMap {
    var result = self
    if orientation >= 5 { (result.width, result.height) = (height, width) }
    result.depths.removeAll(keepingCapacity: true)
    for row in 0..<result.height {
      for column in 0..<result.width {
        let (x, y) =
          switch orientation {
          case 2: (width - 1 - column, row)
          case 3: (width - 1 - column, height - 1 - row)
          case 4: (column, height - 1 - row)
          case 5: (row, column)
          case 6: (row, height - 1 - column)
          case 7: (width - 1 - row, height - 1 - column)
          case 8: (width - 1 - row, column)
          default: (column, row)
          }
        result.depths.append(depths[y * width + x])
      }
    }
    return result
  }
}
