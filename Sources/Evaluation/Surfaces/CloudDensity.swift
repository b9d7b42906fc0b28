import SceneModel

/// How many points a dense cloud has.
package struct CloudDensity: Codable, Hashable, Sendable {
  package var points: Int
  /// Of the sparse reconstruction, within the bounding box of the cloud, which may be of an object
  /// alone; nil without a reconstruction.
  package var sparsePoints: Int?
  /// Points of the cloud per cubic unit of the reference, within the bounding box of the reference
  /// surface; of the cloud itself, if there is none.
  package var pointsPerCubicUnit: Double

  /// `alignment` takes the cloud, which is in the frame of `sparse`, to that of `reference`.
  package init(
    _ cloud: PointCloud, sparse: Reconstruction?, _ alignment: SimilarityTransform,
    reference: Mesh?
  ) {
    points = cloud.count
    let box = Bounds(cloud.positions)
    sparsePoints = sparse.map { sparse in
      sparse.points.count { box?.contains(SIMD3<Float>($0.position)) ?? false }
    }
    let positions = cloud.positions.map { SIMD3<Float>(alignment * SIMD3<Double>($0)) }
    let bounds = Bounds(reference?.positions ?? positions)
    let inside = positions.count { bounds?.contains($0) ?? false }
    let volume = bounds?.volume ?? 0
    pointsPerCubicUnit = volume > 0 ? Double(inside) / volume : 0
  }
}
