import Kernels
import SceneModel

extension ObjectIsolation {
  /// The box around the isolated object, or around the scene if there is no clear object; cheap.
  ///
  /// Uses the sparse points if there is no dense cloud. Nil without points.
  func bounds(
    _ cloud: PointCloud? = nil, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> (min: SIMD3<Float>, max: SIMD3<Float>)? {
    let points = try cloud ?? reconstruction.sparseCloud(context.control)
    guard points.count > 0 else { return nil }
    let result = try run(points, reconstruction, context)
    let kept = points.positions.indices.filter { result.isKept[$0] }
    let share =
      result.failure == nil && cloud != nil
      ? options.trimmedObjectShare : options.trimmedSceneShare
    let axes = (0..<3).compactMap { axis -> (Float, Float)? in
      let values = kept.map { points.positions[$0][axis] }.sorted()
      guard let first = values.first, let last = values.last else { return nil }
      guard values.count > options.minimumTrimmedPoints else { return (first, last) }
      let skip = Int(share * Double(values.count))
      return (values[skip], values[values.count - 1 - skip])
    }
    guard axes.count == 3 else { return nil }
    return (
      [axes[0].0, axes[1].0, axes[2].0], [axes[0].1, axes[1].1, axes[2].1]
    )
  }
}

extension Reconstruction {
  /// The triangulated points as a cloud without normals; footprints are half the median distance of
  /// a point from its third neighbor.
  func sparseCloud(_ control: KernelControl) throws -> PointCloud {
    var cloud = PointCloud()
    for point in points {
      let position = SIMD3<Float>(point.position)
      guard position.isFinite else { continue }
      cloud.positions.append(position)
      cloud.colors.append(point.color)
      cloud.photoIndices.append(contentsOf: point.track.map { UInt16($0.photo.index) })
      cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
    }
    // Each point is its own nearest neighbor.
    let nearest = try NearestPoints(
      of: cloud.positions, in: cloud.positions, neighbors: 4, control)
    let spacing =
      cloud.positions.indices.map { nearest.distances[$0 * 4 + 3] }
      .filter { $0 > 0 && $0.isFinite }.upperMedian ?? 1
    cloud.consistency = Array(repeating: 1, count: cloud.count)
    cloud.footprints = Array(repeating: spacing / 2, count: cloud.count)
    return cloud
  }
}
