import SceneModel

/// A height below which nothing is compared.
package struct Floor: Codable, Hashable, Sendable {
  /// The axis that points up: 0, 1 or 2.
  package var axis: Int
  /// In units of the reference.
  package var height: Double

  package init(axis: Int, height: Double) {
    self.axis = axis
    self.height = height
  }

  func isBelow(_ point: SIMD3<Float>) -> Bool { Double(point[axis]) <= height }
}
