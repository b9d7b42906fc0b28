import Kernels
import SceneModel

/// A coarse point cloud, divided into object and surroundings.
struct LabeledCloud: Sendable {
  var cloud: PointCloud
  var isObject: [Bool]
  /// Whether object and surroundings are one rigid scene. If not, a photo shows only those points
  /// of the surroundings that it agrees on.
  var isRigid = true
  /// Surroundings that only some photos show.
  var partialSurroundings: [(photos: Set<Int>, cloud: PointCloud)] = []

  var object: PointCloud { cloud.filtered(by: isObject) }

  var surroundings: PointCloud { cloud.filtered(by: isObject.map { !$0 }) }

  /// All points as labeled discs with a radius in footprints.
  func discs(radius: Float) -> Discs {
    Discs(
      positions: cloud.positions, radii: cloud.footprints.map { radius * $0 },
      labels: isObject.map { $0 ? PointLabel.object : PointLabel.surroundings })
  }

  /// The points that a photo shows of a scene that is not rigid.
  func discs(in photo: ID<Photo>, radius: Float) -> Discs {
    var discs = Discs(positions: [], radii: [], labels: [])
    for point in cloud.positions.indices {
      guard
        isObject[point] || cloud.visiblePhotos(of: point).contains(UInt16(photo.index))
      else { continue }
      discs.positions.append(cloud.positions[point])
      discs.radii.append(radius * cloud.footprints[point])
      discs.labels.append(isObject[point] ? PointLabel.object : PointLabel.surroundings)
    }
    for other in partialSurroundings where other.photos.contains(photo.index) {
      discs.positions += other.cloud.positions
      discs.radii += other.cloud.footprints.map { radius * $0 }
      discs.labels += other.cloud.positions.map { _ in PointLabel.surroundings }
    }
    return discs
  }

  /// The cloud in another frame.
  func transformed(by transform: SimilarityTransform) -> LabeledCloud {
    var result = self
    result.cloud = cloud.transformed(by: transform)
    result.partialSurroundings = partialSurroundings.map {
      ($0.photos, $0.cloud.transformed(by: transform))
    }
    return result
  }
}

extension PointCloud {
  /// The cloud in another frame.
  fileprivate func transformed(by transform: SimilarityTransform) -> PointCloud {
    var result = self
    result.positions = positions.map { SIMD3<Float>(transform * SIMD3<Double>($0)) }
    result.footprints = footprints.map { Float(transform.scale) * $0 }
    result.normals = normals.map { SIMD3<Float>(transform.rotation * SIMD3<Double>($0)) }
    return result
  }
}
