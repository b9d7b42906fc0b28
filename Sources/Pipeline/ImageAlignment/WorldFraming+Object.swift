import Foundation
import SceneModel

/// The part of the scene that most photos look at.
struct ObjectRegion: Sendable {
  /// The points that most photos look at.
  var core: [SIMD3<Double>] = []
  /// The points within one and a half camera distances of the centre.
  var surroundings: [SIMD3<Double>] = []
  /// The component-wise median of the core.
  var center = SIMD3<Double>.zero
  /// The median distance of the cameras from the centre.
  var cameraDistance = 1.0

  init(_ reconstruction: Reconstruction) {
    let registered = reconstruction.registered
    let points = reconstruction.points
    let step = max(1, points.count / 4000)
    let sample = stride(from: 0, to: points.count, by: step).map { points[$0].position }
    let views = sample.map { point in
      registered.count { photo in
        guard let pose = reconstruction.poses[photo.index] else { return false }
        let camera = reconstruction.camera(of: photo)
        let inCamera = pose * point
        guard inCamera.z > 0 else { return false }
        let pixel = camera.project(inCamera)
        return pixel.x >= 0 && pixel.y >= 0 && pixel.x < Double(camera.width)
          && pixel.y < Double(camera.height)
      }
    }
    let most = views.sorted()[views.count * 9 / 10]
    core = zip(sample, views).filter { 10 * $1 >= 8 * most }.map(\.0)
    center = Self.median(core)
    let distances = reconstruction.poses.compactMap { $0.map { ($0.center - center).length } }
      .sorted()
    if !distances.isEmpty { cameraDistance = distances[distances.count / 2] }
    surroundings = sample.filter { ($0 - center).length < 1.5 * cameraDistance }
  }

  private static func median(_ points: [SIMD3<Double>]) -> SIMD3<Double> {
    guard !points.isEmpty else { return .zero }
    func middle(_ axis: Int) -> Double { points.map { $0[axis] }.sorted()[points.count / 2] }
    return [middle(0), middle(1), middle(2)]
  }
}

/// The up direction that the cameras' attitude suggests.
struct CameraUp: Sendable {
  var direction: SIMD3<Double>

  init(_ reconstruction: Reconstruction) {
    let rotations = reconstruction.poses.compactMap { $0?.rotation.conjugate }
    let mean =
      rotations.reduce(SIMD3<Double>.zero) { $0 + $1 * [0, -1, 0] } / Double(rotations.count)
    let back =
      rotations.reduce(SIMD3<Double>.zero) { $0 + $1 * [0, 0, -1] } / Double(rotations.count)
    // Cameras that look straight down have their tops all around: then their backs point up.
    guard mean.length > 0.3 || mean.length > back.length else {
      direction = back.length > 0.1 ? back.normalized : [0, 1, 0]
      return
    }
    direction = mean.normalized
    // Held level, a camera's x axis is horizontal whatever it looks at: more exact than the mean of
    // tilted tops, where the axes spread enough.
    var scatter = [SIMD3<Double>](repeating: .zero, count: 3)
    for rotation in rotations {
      let x = rotation * SIMD3(1, 0, 0)
      for axis in 0..<3 { scatter[axis] += x[axis] * x / Double(rotations.count) }
    }
    let (values, vectors) = Matrix3(rows: scatter[0], scatter[1], scatter[2]).symmetricEigen
    let normal = vectors[0].dot(mean) < 0 ? -vectors[0] : vectors[0]
    if values[0] < 0.02, values[1] > 0.1, normal.dot(direction) > 0.6 { direction = normal }
  }
}

/// The plane under the object: a thin layer of points, wide, with next to nothing below it.
///
/// On a plain table it holds few of the points; then it has to stand out from what is above it.
struct SupportPlane: Sendable {
  /// Unit length, to the cameras' side.
  var normal: SIMD3<Double>
  var offset: Double

  func distance(_ point: SIMD3<Double>) -> Double { normal.dot(point) - offset }

  /// Nil where no plane that fits the cameras' up direction holds enough points.
  init?(
    _ object: ObjectRegion, centers: [SIMD3<Double>], up: SIMD3<Double>,
    _ options: WorldFraming.Options
  ) {
    guard object.surroundings.count >= 50 else { return nil }
    let thickness = options.planeThickness * object.cameraDistance
    // Most cameras are held level: a plane near their up direction comes first.
    for degrees in [options.planeTiltDegrees / 3, options.planeTiltDegrees] {
      let found = SupportPlane(
        object.surroundings, up: up, tilt: degrees * .pi / 180, thickness, options)
      if let found, found.isSupport(object, centers, thickness, options) {
        self = found
        return
      }
    }
    return nil
  }

  /// The plane with the most of the low points on it and the fewest points below it.
  private init?(
    _ points: [SIMD3<Double>], up: SIMD3<Double>, tilt: Double, _ thickness: Double,
    _ options: WorldFraming.Options
  ) {
    let heights = points.map { $0.dot(up) }.sorted()
    // With an up direction that is off, low points may lie a little above the middle.
    let limit = heights[heights.count / 2] + 2 * thickness
    let low = points.filter { $0.dot(up) < limit }
    var random = SplitMix64(seed: options.seed)
    var best = (score: 0, normal: up, offset: 0.0)
    for _ in 0..<1000 {
      let triple = (0..<3).map { _ in low[random.below(low.count)] }
      var normal = (triple[1] - triple[0]).cross(triple[2] - triple[0]).normalized
      if normal.dot(up) < 0 { normal = -normal }
      guard normal.dot(up) > cos(tilt) else { continue }
      let offset = normal.dot(triple[0])
      let score = low.reduce(0) { sum, point in
        let height = normal.dot(point) - offset
        return abs(height) < thickness ? sum + 1 : height < -3 * thickness ? sum - 2 : sum
      }
      if score > best.score { best = (score, normal, offset) }
    }
    guard best.score > 0 else { return nil }
    (normal, offset) = (best.normal, best.offset)
    for _ in 0..<3 { refit(low, thickness, up) }
    guard normal.dot(up) > cos(tilt) else { return nil }
  }

  private func isSupport(
    _ object: ObjectRegion, _ centers: [SIMD3<Double>], _ thickness: Double,
    _ options: WorldFraming.Options
  ) -> Bool {
    let points = object.surroundings
    let heights = points.map(distance)
    let onPlane = heights.count { abs($0) < thickness }
    let next = heights.count { $0 >= thickness && $0 < 3 * thickness }
    let above = heights.count { $0 >= thickness }
    let below = heights.count { $0 < -3 * thickness }
    let seeing = centers.count { distance($0) > 0 }
    let share = Double(onPlane) / Double(points.count)
    let isClear = share >= options.planeShare && 10 * below <= above + onPlane
    let isLayer =
      share >= options.minimumPlaneShare && onPlane >= 40 && 5 * onPlane >= 6 * next
      && 8 * below <= onPlane
      && width(points.filter { abs(distance($0)) < thickness }) >= 0.7 * width(object.core)
    // Nobody takes photos from below.
    return (isClear || isLayer) && 10 * seeing >= 9 * centers.count
      && distance(object.center) > -thickness
  }

  /// The root mean square distance from the mean along the plane.
  private func width(_ points: [SIMD3<Double>]) -> Double {
    guard !points.isEmpty else { return 0 }
    let flat = points.map { $0 - distance($0) * normal }
    let mean = flat.reduce(.zero, +) / Double(flat.count)
    return (flat.reduce(0) { $0 + ($1 - mean).squaredLength } / Double(flat.count)).squareRoot()
  }

  /// Least squares over the points on the plane.
  private mutating func refit(
    _ points: [SIMD3<Double>], _ thickness: Double, _ up: SIMD3<Double>
  ) {
    let inliers = points.filter { abs(distance($0)) < thickness }
    guard inliers.count >= 10 else { return }
    let mean = inliers.reduce(.zero, +) / Double(inliers.count)
    var rows = [SIMD3<Double>](repeating: .zero, count: 3)
    for point in inliers {
      let d = point - mean
      for axis in 0..<3 { rows[axis] += d[axis] * d / Double(inliers.count) }
    }
    let vector = Matrix3(rows: rows[0], rows[1], rows[2]).symmetricEigen.vectors[0]
    normal = vector.dot(up) < 0 ? -vector : vector
    offset = normal.dot(mean)
  }
}
