import SceneModel

/// The part of the scene that most photos show.
struct ObjectRegion: Sendable {
  /// Approximate maximum number of points that are examined. Chosen.
  private static let maximumPoints = 4000
  /// A point is in view of most photos if at least eight tenths as many photos show it as the ninth
  /// decile of all points. Chosen.
  private static let (coreTenths, decile) = (8, 9)
  /// Radius of the surroundings in camera distances. Chosen.
  private static let surroundingsRadius = 1.5

  /// The points that are in view of most photos.
  var core: [SIMD3<Double>] = []
  /// The points within `surroundingsRadius` camera distances of the center.
  var surroundings: [SIMD3<Double>] = []
  /// The component-wise median of the core.
  var center = SIMD3<Double>.zero
  /// The median distance of the cameras from the center.
  var cameraDistance = 1.0

  init(_ reconstruction: Reconstruction) {
    let registered = reconstruction.registered
    let points = reconstruction.points
    let step = max(1, points.count / Self.maximumPoints)
    let sample = stride(from: 0, to: points.count, by: step).map { points[$0].position }
    let views = sample.map { point in
      registered.count { photo in
        guard let pose = reconstruction.poses[photo.index] else { return false }
        let camera = reconstruction.camera(of: photo)
        let inCamera = pose * point
        guard inCamera.z > 0 else { return false }
        return camera.contains(camera.project(inCamera))
      }
    }
    let most = views.sorted()[views.count * Self.decile / 10]
    core = zip(sample, views).filter { 10 * $1 >= Self.coreTenths * most }.map(\.0)
    center = Self.median(core)
    let distances = reconstruction.poses.compactMap { $0.map { ($0.center - center).length } }
    if let median = distances.upperMedian { cameraDistance = median }
    surroundings = sample.filter { ($0 - center).length < Self.surroundingsRadius * cameraDistance }
  }

  private static func median(_ points: [SIMD3<Double>]) -> SIMD3<Double> {
    func median(_ axis: Int) -> Double { points.map { $0[axis] }.upperMedian ?? 0 }
    return [median(0), median(1), median(2)]
  }
}
