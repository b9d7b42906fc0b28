import SceneModel

/// How many points a dense cloud has.
package struct CloudDensity: Codable, Hashable, Sendable {
  package var points: Int
  /// Of the sparse reconstruction; nil without one.
  package var sparsePoints: Int?
  /// Points of the cloud per cubic unit of the reference, within the bounding box of the reference
  /// surface; of the cloud itself, if there is none.
  package var pointsPerCubicUnit: Double

  /// `alignment` takes the cloud to the frame of `reference`.
  package init(
    _ cloud: PointCloud, sparsePoints: Int?, _ alignment: SimilarityTransform, reference: Mesh?
  ) {
    points = cloud.count
    self.sparsePoints = sparsePoints
    let positions = cloud.positions.map { SIMD3<Float>(alignment * SIMD3<Double>($0)) }
    let bounds = reference?.bounds ?? Mesh(positions: positions).bounds ?? (.zero, .zero)
    let size = SIMD3<Double>(bounds.max) - SIMD3<Double>(bounds.min)
    let inside = positions.count { pointwiseMin(pointwiseMax($0, bounds.min), bounds.max) == $0 }
    let volume = size.x * size.y * size.z
    pointsPerCubicUnit = volume > 0 ? Double(inside) / volume : 0
  }
}
