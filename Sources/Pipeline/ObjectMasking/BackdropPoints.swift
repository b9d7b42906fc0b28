import SceneModel

/// What the photos that see them show at the points of a coarse cloud, whose own colors are not
/// known yet.
struct BackdropPoints: Sendable {
  /// Whether most photos show the backdrop.
  private(set) var isBackdrop: [Bool] = []
  /// The mean RGB colors, 0…255.
  private(set) var colors: [SIMD3<Float>] = []

  init(_ cloud: PointCloud, _ photos: [ReducedPhoto], photoCount: Int) {
    var byPhoto = [ReducedPhoto?](repeating: nil, count: photoCount)
    for photo in photos { byPhoto[photo.id.index] = photo }
    for point in cloud.positions.indices {
      var (sum, seen, marked) = (SIMD3<Float>(), 0, 0)
      for index in cloud.visiblePhotos(of: point) {
        guard let photo = byPhoto[Int(index)],
          let pixel = photo.pixel(of: cloud.positions[point])
        else { continue }
        sum += photo.color(at: pixel)
        seen += 1
        if photo.showsBackdrop(at: pixel) { marked += 1 }
      }
      isBackdrop.append(2 * marked > seen)
      colors.append(sum / Float(max(1, seen)))
    }
  }
}
