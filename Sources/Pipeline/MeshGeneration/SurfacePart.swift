import SceneModel

/// A part of a surface. Rules that depend on the whole surface use these values instead, so that
/// parts that overlap agree on what they have in common.
struct SurfacePart: Sendable {
  /// The box in which the part is made, in world units.
  var low: SIMD3<Double>
  var high: SIMD3<Double>
  /// Surface within this distance of the sides of the box may continue outside.
  var rim: Double
  /// Components that do not continue outside are removed if they have less area.
  var minimumComponentArea: Double
  /// What stands for the extent of the whole surface.
  var extent: Float
  /// Side of the cells in which free space is counted. The boxes of all parts are on one lattice of
  /// such cells, and at most `FreeSpace.maximumCells` large.
  var freeSpaceCell: Double

  /// Whether the surface at a point may continue outside.
  func isAtRim(_ point: SIMD3<Float>) -> Bool {
    let point = SIMD3<Double>(point)
    return (0..<3).contains { point[$0] < low[$0] + rim || point[$0] > high[$0] - rim }
  }
}
