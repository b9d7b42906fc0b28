import SceneModel

extension Reconstruction {
  /// The median depth of the points that each photo observes; nil for photos that observe none.
  func medianDepths(of cloud: PointCloud) -> [Double?] {
    var depths = [[Double]](repeating: [], count: photos.count)
    for index in cloud.positions.indices {
      let position = SIMD3<Double>(cloud.positions[index])
      for photo in cloud.visiblePhotos(of: index) where Int(photo) < photos.count {
        guard let pose = poses[Int(photo)] else { continue }
        let depth = (pose * position).z
        if depth > 0 { depths[Int(photo)].append(depth) }
      }
    }
    return depths.map(\.upperMedian)
  }
}
