import SceneModel

/// Determines the direction opposite to gravity.
///
/// The sources, in order of preference: the user; gravity; GPS; the plane that supports the object;
/// another alignment whose up direction is known; the orientation of the cameras, which people hold
/// level.
struct UpEstimation: Sendable {
  struct Result: Sendable {
    /// Unit vector in the frame of the reconstruction.
    var up: SIMD3<Double>
    var source: WorldFrame.Up
    /// The plane that supports the object, if there is one.
    var plane: SupportPlane?
    /// The fit of the cameras to their GPS positions, if they have such.
    var gps: GPSFit?
  }

  var options = WorldAlignment.Options()

  /// `posesInUpFrame` has poses of photos, by ID, in a frame whose +y is up.
  func run(
    _ reconstruction: Reconstruction, _ object: ObjectRegion, posesInUpFrame: [RigidTransform?],
    _ notes: StageNotes
  ) -> Result {
    let prior = prior(reconstruction, object, posesInUpFrame: posesInUpFrame, notes)
    let plane =
      options.findsSupport
      ? SparseSupportDetection(options: options).run(
        object, centers: reconstruction.poses.compactMap { $0?.center }, up: prior.up) : nil
    var result = Result(up: prior.up, source: prior.source, plane: plane)
    let isMeasured = prior.source == .gravity
    if !isMeasured, let plane {
      result.up = plane.normal
      if prior.source != .chosen { result.source = .supportPlane }
    }
    result.gps = GPSFit(reconstruction, up: result.up, options)
    if !isMeasured, prior.source != .chosen, let up = result.gps?.up {
      (result.up, result.source) = (up, .gps)
    }
    return result
  }

  /// The up direction before the search for a plane.
  private func prior(
    _ reconstruction: Reconstruction, _ object: ObjectRegion, posesInUpFrame: [RigidTransform?],
    _ notes: StageNotes
  ) -> (up: SIMD3<Double>, source: WorldFrame.Up) {
    if case .photos(let side) = options.chosenUp {
      return (CameraUp(reconstruction, side: side, options.cameraUp).direction, .chosen)
    }
    let gravity = GravityUp(options: options.gravity).run(options.readings, reconstruction, notes)
    if let gravity { return (gravity, .gravity) }
    if let up = meanUp(of: reconstruction, posesInUpFrame) { return (up, .placement) }
    let cameras = CameraUp(reconstruction, options.cameraUp)
    let isUpsideDown =
      !cameras.isSignCertain
      && WiderEndUp(options: options.widerEnd).isUpsideDown(object.core, up: cameras.direction)
    return (isUpsideDown ? -cameras.direction : cameras.direction, .cameras)
  }

  /// The mean of the up directions that the photos have in another frame, whose +y is up; nil
  /// without common photos.
  private func meanUp(
    of reconstruction: Reconstruction, _ posesInUpFrame: [RigidTransform?]
  ) -> SIMD3<Double>? {
    let ups = zip(reconstruction.poses, posesInUpFrame).compactMap { own, other -> SIMD3<Double>? in
      guard let own, let other else { return nil }
      return own.rotation.conjugate * (other.rotation * [0, 1, 0])
    }
    return ups.isEmpty ? nil : ups.reduce(.zero, +).normalized
  }
}
