import CKernels

/// The patch of one pixel: a plane given by its inverse depth at the pixel's center and the
/// gradient of the inverse depth over the pixel grid. An inverse depth of 0 means that there is no
/// patch.
package struct Patch: Hashable, Sendable {
  /// 1 / z in the camera frame, at the pixel's center.
  package var inverseDepth: Float
  /// Change of the inverse depth per pixel in x and y.
  package var gradient: SIMD2<Float>
  /// 1 − ZNCC, the mean of the best two sources; 2 without a patch.
  package var cost: Float

  package init(inverseDepth: Float, gradient: SIMD2<Float>, cost: Float) {
    self.inverseDepth = inverseDepth
    self.gradient = gradient
    self.cost = cost
  }
}

extension ck_patch {
  /// No patch.
  static let none = ck_patch(inverse_depth: 0, gradient_x: 0, gradient_y: 0, cost: 2)

  init(_ patch: Patch) {
    self.init(
      inverse_depth: patch.inverseDepth, gradient_x: patch.gradient.x,
      gradient_y: patch.gradient.y, cost: patch.cost)
  }
}

extension Patch {
  init(_ patch: ck_patch) {
    self.init(
      inverseDepth: patch.inverse_depth, gradient: [patch.gradient_x, patch.gradient_y],
      cost: patch.cost)
  }
}
