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
    let box = Box(cloud.positions)
    sparsePoints = sparse.map { $0.points.count { box.contains(SIMD3<Float>($0.position)) } }
    let positions = cloud.positions.map { SIMD3<Float>(alignment * SIMD3<Double>($0)) }
    let bounds = Box(reference?.positions ?? positions)
    let size = bounds.size
    let inside = positions.count(where: bounds.contains)
    let volume = size.x * size.y * size.z
    pointsPerCubicUnit = volume > 0 ? Double(inside) / volume : 0
  }
}

/// An axis-aligned box.
private struct Box {
  var (low, high) = (SIMD3<Float>.zero, SIMD3<Float>.zero)

  init(_ positions: [SIMD3<Float>]) {
    if let bounds = Mesh(positions: positions).bounds { (low, high) = bounds }
  }

  var size: SIMD3<Double> { SIMD3<Double>(high) - SIMD3<Double>(low) }

  func contains(_ position: SIMD3<Float>) -> Bool {
    pointwiseMin(pointwiseMax(position, low), high) == position
  }
}
