/// The weights and color offsets of a view in one triangle.
package struct FacePaint: Sendable {
  /// Index of the triangle.
  package var face: Int32
  /// At each corner; they sum to 1 over all views.
  package var weights: SIMD3<Float>
  /// RGB offsets, 0…255, added to the photo's colors at each corner.
  package var offsets: (SIMD3<Float>, SIMD3<Float>, SIMD3<Float>)

  package init(
    face: Int32, weights: SIMD3<Float>, offsets: (SIMD3<Float>, SIMD3<Float>, SIMD3<Float>)
  ) {
    self.face = face
    self.weights = weights
    self.offsets = offsets
  }
}
