/// Color offsets added to the photos at each corner, so that they match without a seam.
struct LevelingOffsets: Sendable {
  /// One per share of `CornerWeights`; RGB, 0…255.
  var offsets: [SIMD3<Float>]
  /// A color for each vertex: the photos' consensus, interpolated where no photo sees it.
  var vertexColors: [SIMD3<Float>]
}
