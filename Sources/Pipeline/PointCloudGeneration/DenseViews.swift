import Foundation
import Kernels
import SceneModel

/// The views that take part in the dense stage, with their cameras, sources and file fingerprints.
struct DenseViews: Sendable {
  struct View: Codable, Sendable {
    var photo: ID<Photo>
    /// Pinhole camera without distortion, at the stage's resolution.
    var camera: Camera
    var cameraFromWorld: RigidTransform
    /// Indices in `views` of the source views, best first.
    var sources: [Int]
    /// Share of the photo inside its mask, 0…1.
    var objectShare: Double

    var pixelCount: Int { camera.width * camera.height }
  }

  /// In photo order.
  let views: [View]
  /// Sparse points that each view's photo observes, in world coordinates: what the first step
  /// starts from. Nil if they were not read with views that another process selected.
  var points: [[SIMD3<Double>]?]
  /// For each step, the fingerprint of each view's file.
  let fingerprints: [PatchWorkspace.Step: [UInt64]]

  /// Throws `PipelineError.noSurface` if no two photos share enough points.
  init(
    _ reconstruction: Reconstruction, images: ImageStore, options: PointCloudGeneration.Options,
    _ control: KernelControl
  ) throws {
    let sources = try SourceSelection(options: options.sourceSelection)
      .run(reconstruction, viewPixels: options.maximumPixelsPerView, control)
    let photos = reconstruction.registered.filter {
      let detail = reconstruction.photos[$0.index].detail(at: options.maximumPixelsPerView)
      return !sources[$0.index].isEmpty && detail >= options.minimumDetail
    }
    guard !photos.isEmpty else {
      throw PipelineError.noSurface(reason: "no two photos share enough points.")
    }
    let position = Dictionary(uniqueKeysWithValues: photos.enumerated().map { ($1, $0) })
    views = try photos.map { photo in
      let limit = reconstruction.photos[photo.index].sharpPixels ?? .max
      return View(
        photo: photo,
        camera: try images.pinholeCamera(
          of: photo, in: reconstruction, maximumPixels: min(limit, options.maximumPixelsPerView)),
        cameraFromWorld: reconstruction.poses[photo.index] ?? .identity,
        sources: sources[photo.index].compactMap { position[$0] },
        objectShare: reconstruction.photos[photo.index].mask?.coverage ?? 1)
    }
    let observed = Self.points(of: reconstruction)
    let points = photos.map { observed[$0.index] }
    self.points = points
    fingerprints = try Self.fingerprints(views, points, reconstruction, images, options)
  }

  /// Views that another process selected, without points.
  init(_ views: [View], _ fingerprints: [PatchWorkspace.Step: [UInt64]]) {
    (self.views, self.fingerprints) = (views, fingerprints)
    points = Array(repeating: nil, count: views.count)
  }

  var indices: Range<Int> { views.indices }
  var pixelCount: Int { views.reduce(0) { $0 + $1.pixelCount } }
  /// Pixels inside the masks.
  var objectPixelCount: Double {
    views.reduce(0) { $0 + Double($1.pixelCount) * $1.objectShare }
  }
  var largestPixelCount: Int { views.map(\.pixelCount).max() ?? 0 }

  /// What a view's file of a step must match.
  func key(_ step: PatchWorkspace.Step, _ index: Int) -> PatchWorkspace.Key {
    let view = views[index]
    let divisor = step.isCoarse ? 2 : 1
    return PatchWorkspace.Key(
      step: step, photo: view.photo, width: view.camera.width / divisor,
      height: view.camera.height / divisor,
      fingerprint: fingerprints[step]?[index] ?? 0)
  }

  /// The views and all their sources, ascending.
  func withSources(_ indices: [Int]) -> [Int] {
    Set(indices.flatMap { [$0] + views[$0].sources }).sorted()
  }

  /// The sparse points that each photo observes, by photo ID.
  private static func points(of reconstruction: Reconstruction) -> [[SIMD3<Double>]] {
    var points = [[SIMD3<Double>]](repeating: [], count: reconstruction.photos.count)
    for point in reconstruction.points {
      for observation in point.track { points[observation.photo.index].append(point.position) }
    }
    return points
  }
}

extension DenseViews {
  /// Each step's fingerprint includes those of its input files, so that exactly the files that
  /// depend on a change are recomputed.
  private static func fingerprints(
    _ views: [View], _ points: [[SIMD3<Double>]], _ reconstruction: Reconstruction,
    _ images: ImageStore, _ options: PointCloudGeneration.Options
  ) throws -> [PatchWorkspace.Step: [UInt64]] {
    let patchOptions = try Fingerprint.content(of: options.patches)
    let (filterOptions, coarseFilter) = (
      try Fingerprint.content(of: options.filter), try Fingerprint.content(of: options.coarseFilter)
    )
    let photos = try views.map { view in
      fingerprint(view, try images.fingerprint(of: view.photo), reconstruction)
    }
    let coarse = chain(photos, views) { fingerprint, view in
      fingerprint.add(patchOptions)
      fingerprint.add(points[view].count)
      points[view].forEach { fingerprint.add($0) }
    }
    let coarseStates = chain(coarse, views) { fingerprint, _ in fingerprint.add(coarseFilter) }
    let completes = options.completes ? 1 : 0
    let coarseCompleted = chain(coarseStates, views) { fingerprint, _ in
      fingerprint.add(completes)
    }
    let patches = chain(coarseCompleted, views)
    let states = chain(patches, views) { fingerprint, _ in fingerprint.add(filterOptions) }
    let completed = chain(states, views) { fingerprint, _ in fingerprint.add(completes) }
    let completedStates = chain(completed, views)
    let silhouettes = try silhouettes(reconstruction, images)
    let clouds = chain(completedStates, views) { fingerprint, view in
      fingerprint.add(silhouettes)
      // Points list the photos that observe them.
      for view in [view] + views[view].sources { fingerprint.add(views[view].photo.index) }
    }
    return [
      .view: photos, .coarse: coarse, .coarseStates: coarseStates,
      .coarseCompleted: coarseCompleted, .patches: patches, .states: states,
      .completed: completed, .completedStates: completedStates, .cloud: clouds,
    ]
  }

  /// The fingerprint of all masks, and of the photos' cameras and poses.
  private static func silhouettes(
    _ reconstruction: Reconstruction, _ images: ImageStore
  ) throws -> UInt64 {
    var fingerprint = Fingerprint()
    for photo in reconstruction.registered where images.hasMask(photo) {
      fingerprint.add(try images.fingerprint(of: photo))
      fingerprint.add(reconstruction.camera(of: photo))
      fingerprint.add(reconstruction.poses[photo.index] ?? .identity)
    }
    return fingerprint.value
  }

  /// The fingerprints of a step that reads the files of a view and its sources; `add` contributes
  /// further inputs.
  private static func chain(
    _ inputs: [UInt64], _ views: [View],
    _ add: (inout Fingerprint, _ view: Int) -> Void = { _, _ in }
  ) -> [UInt64] {
    views.indices.map { index in
      var fingerprint = Fingerprint()
      fingerprint.add(inputs[index])
      fingerprint.add(views[index].sources.count)
      views[index].sources.forEach { fingerprint.add(inputs[$0]) }
      add(&fingerprint, index)
      return fingerprint.value
    }
  }

  /// The fingerprint of a view's photo, cameras and pose, and of the program.
  private static func fingerprint(
    _ view: View, _ photo: UInt64, _ reconstruction: Reconstruction
  ) -> UInt64 {
    var fingerprint = Fingerprint()
    fingerprint.add(ProgramIdentity.fingerprint)
    fingerprint.add(photo)
    // The photo's original camera, and the pinhole camera derived from it at this resolution.
    for camera in [reconstruction.camera(of: view.photo), view.camera] { fingerprint.add(camera) }
    fingerprint.add(view.cameraFromWorld)
    return fingerprint.value
  }
}

extension Fingerprint {
  fileprivate mutating func add(_ camera: Camera) {
    add(camera.width)
    add(camera.height)
    add(camera.focalLength)
    add(camera.principalPoint)
    add(camera.distortion)
  }

  fileprivate mutating func add(_ pose: RigidTransform) {
    pose.rotation.matrix.elements.forEach { add($0) }
    add(pose.translation)
  }
}
