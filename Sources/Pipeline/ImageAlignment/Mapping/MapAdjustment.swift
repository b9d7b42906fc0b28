import Kernels
import SceneModel

/// Bundle adjustment of a map: locally around one photo, or globally.
struct MapAdjustment: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Number of photos in a local adjustment, including the new one. Chosen: COLMAP's default,
    /// too.
    var localPhotoCount = 6
    /// Maximum number of iterations of a local and of a global adjustment; the final one has twice
    /// as many. Chosen.
    var localIterations = 15
    var globalIterations = 30
    /// Relative cost decrease at which an adjustment terminates, while the map grows and for the
    /// final one. Under the Huber loss, single points keep drifting long after cameras and poses
    /// have converged. Chosen.
    var growthTolerance = 1e-4
    var finalTolerance = 5e-6
    /// Residual in pixels at which the Huber loss changes from quadratic to linear. Chosen.
    var huberWidth = 1.0
    /// Standard deviation of a focal length from EXIF, relative. Chosen.
    var exifFocalDeviation = 0.15
    /// Standard deviation of an assumed focal length, relative. Chosen.
    var assumedFocalDeviation = 0.5
    /// Standard deviation of the principal point, relative to the longer side of the photo. Chosen.
    var principalPointDeviation = 0.02
    /// Standard deviation of k1 and k2. Chosen.
    var radialDeviation = 0.3
    /// Number of registered photos of a camera from which on the focal length, k1, k2 and the
    /// principal point are refined. Chosen.
    var photosForFocalLength = 3
    var photosForK1 = 3
    var photosForK2 = 5
    var photosForPrincipalPoint = 6
    /// Maximum relative cost increase accepted for a simpler camera model. Chosen.
    var simplificationTolerance = 0.01
    /// Approximate number of observations used for this decision. Chosen.
    var simplificationObservations = 20_000
  }

  var options = Options()
  /// The cameras before any adjustment, which the priors are centered on.
  var initialCameras: [Camera]
  /// Parameters that are held constant regardless of the number of photos.
  var fixedParameters: BundleAdjustment.CameraFreedom = []

  /// Adjusts `photo`, the photos that share the most points with it, and the points it observes.
  /// The other points of these photos are constant and anchor them; intrinsics are constant.
  func adjustLocally(
    around photo: Int, _ map: inout SparseMap, _ control: KernelControl
  ) throws {
    var shared = [Int](repeating: 0, count: map.photos.poses.count)
    var points: [Int] = []
    for index in map.tracks.observationsOfPhoto[photo] where map.isActive[Int(index)] {
      let track = Int(map.tracks.trackOfObservation[Int(index)])
      points.append(track)
      for other in map.activeObservations(of: track) { shared[Int(map.tracks.photos[other])] += 1 }
    }
    guard points.count >= 3 else { return }
    // The first photo fixes the gauge: its pose is constant.
    let neighbors = map.registered.dropFirst().filter { $0 != photo && shared[$0] > 0 }
      .sorted { (-shared[$0], $0) < (-shared[$1], $1) }.prefix(options.localPhotoCount - 1)
    var poses = map.photos.poses.map { _ in BundleAdjustment.PoseFreedom.constant }
    for index in [photo] + neighbors { poses[index] = .free }
    let free = Set(points)
    var anchors = Set<Int>()
    for neighbor in neighbors {
      for index in map.tracks.observationsOfPhoto[neighbor] where map.isActive[Int(index)] {
        let track = Int(map.tracks.trackOfObservation[Int(index)])
        if !free.contains(track) { anchors.insert(track) }
      }
    }
    try adjust(
      points, anchors: anchors.sorted(), poses: poses,
      cameras: map.photos.cameras.map { _ in [] }, &map, iterations: options.localIterations,
      tolerance: options.growthTolerance, control)
  }

  /// Adjusts all poses and points, and the intrinsics that the data constrains.
  @discardableResult
  func adjustGlobally(
    _ map: inout SparseMap, isFinal: Bool = false, _ control: KernelControl
  ) throws -> BundleAdjustment.Summary? {
    let before = map
    let points = map.isTriangulated.indices.filter { map.isTriangulated[$0] }
    var poses = map.photos.poses.map { _ in BundleAdjustment.PoseFreedom.free }
    if let first = map.registered.first { poses[first] = .constant }
    if map.registered.count > 1 { poses[map.registered[1]] = .scaleFixed }
    let (iterations, tolerance) =
      isFinal
      ? (2 * options.globalIterations, options.finalTolerance)
      : (options.globalIterations, options.growthTolerance)
    let summary = try adjust(
      points, poses: poses, cameras: freedom(map), &map, iterations: iterations,
      tolerance: tolerance, control)
    guard !map.photos.cameras.allSatisfy(\.isPlausible) else { return summary }
    // Weak geometry can produce implausible intrinsics; repeat with constant intrinsics.
    map = before
    return try adjust(
      points, poses: poses, cameras: map.photos.cameras.map { _ in [] }, &map,
      iterations: iterations, tolerance: tolerance, control)
  }

  /// The parameters of each camera that its number of photos constrains.
  private func freedom(_ map: SparseMap) -> [BundleAdjustment.CameraFreedom] {
    var photos = [Int](repeating: 0, count: map.photos.cameras.count)
    for photo in map.registered { photos[Int(map.photos.cameraOfPhoto[photo])] += 1 }
    return photos.map { count in
      var freedom: BundleAdjustment.CameraFreedom = []
      if count >= options.photosForFocalLength { freedom.insert(.focalLength) }
      if count >= options.photosForK1 { freedom.insert(.k1) }
      if count >= options.photosForK2 { freedom.insert(.k2) }
      if count >= options.photosForPrincipalPoint { freedom.insert(.principalPoint) }
      return freedom.subtracting(fixedParameters)
    }
  }

  private func prior(of camera: Camera) -> BundleAdjustment.CameraPrior {
    var prior = BundleAdjustment.CameraPrior()
    prior.focalLength = camera.focalLength.x
    prior.principalPoint = camera.principalPoint
    prior.focalLengthDeviation =
      camera.calibration == .assumed ? options.assumedFocalDeviation : options.exifFocalDeviation
    prior.principalPointDeviation =
      options.principalPointDeviation * camera.longerSide
    prior.radialDeviation = options.radialDeviation
    return prior
  }

  @discardableResult
  private func adjust(
    _ points: [Int], anchors: [Int] = [], poses: [BundleAdjustment.PoseFreedom],
    cameras: [BundleAdjustment.CameraFreedom], _ map: inout SparseMap, iterations: Int,
    tolerance: Double, _ control: KernelControl
  ) throws -> BundleAdjustment.Summary {
    var observations = try map.observations(of: points, control) { !$0.isActive[$1] }
      .batch.observations
    for (anchor, track) in anchors.enumerated() {
      for index in map.tracks.observations(of: track)
      where map.isActive[index] && poses[Int(map.tracks.photos[index])] != .constant {
        observations.append(map.pointObservation(index, point: points.count + anchor))
      }
    }
    var problem = BundleAdjustment.Problem(
      photos: map.photos, points: (points + anchors).map { map.positions[$0] },
      observations: observations)
    for anchor in anchors.indices { problem.isPointFree[points.count + anchor] = false }
    problem.poseFreedom = poses
    problem.cameraFreedom = cameras
    problem.cameraPriors = initialCameras.map(prior)
    var kernel = BundleAdjustment.Options()
    kernel.maximumIterations = iterations
    kernel.functionTolerance = tolerance
    kernel.huberWidth = options.huberWidth
    let summary = try BundleAdjustment(kernel).run(&problem, control: control)
    map.photos = problem.photos
    for (track, position) in zip(points, problem.points) { map.positions[track] = position }
    return summary
  }
}

extension Camera {
  /// False for a focal length, principal point or distortion that no real lens has. The limits
  /// correspond to fields of view of 157° and 4° along the longer side, and to a principal point in
  /// the outer fifth of the photo.
  var isPlausible: Bool {
    let ratio = focalLength.x / longerSide
    let center = principalPoint / SIMD2(Double(width), Double(height))
    return ratio > 0.1 && ratio < 15 && abs(distortion.x) < 1 && abs(distortion.y) < 3
      && center.x > 0.2 && center.x < 0.8 && center.y > 0.2 && center.y < 0.8
  }
}
