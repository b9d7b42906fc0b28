import Foundation
import SceneModel

/// Assigns externally estimated cameras and poses to the photos of a run, by file name.
package struct CameraAssignment: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Minimum number of photos with a camera; fewer are an error.
    package var minimumPhotos = PipelineError.minimumPhotos
    /// Maximum number of file names listed in one message. Chosen.
    package var namesInSentence = 5

    package init() {}
  }

  /// The photos with their assigned cameras and poses.
  package struct Result: Sendable {
    /// The photos of the run with the given poses, bit for bit unless a camera had to be rotated,
    /// and the points observed by at least two of the photos.
    package var reconstruction: Reconstruction
    /// Names of the cameras that have no file.
    package var missing: [String]
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Matches `known` to the ingested photos. Throws `PipelineError.tooFewCameras` if fewer than
  /// `minimumPhotos` photos have a camera.
  package func run(
    _ known: KnownCameras, to ingested: IngestedPhotos, _ context: StageContext
  ) throws -> Result {
    let files = Set(ingested.files.map(\.lastPathComponent))
    let names = PhotoNames(known.reconstruction.photos.map(\.name))
    var assigned = AssignmentBuilder(
      photos: ingested.photos, worldFrame: known.reconstruction.worldFrame)
    for photo in ingested.photos {
      if let index = names.index(of: photo.name) {
        assigned.assignCamera(index, of: known, to: photo)
      } else {
        assigned.leaveOut(photo, because: "no camera of that name was given")
      }
    }
    assigned.copyPoints(of: known)
    let missing = known.reconstruction.photos.map(\.name)
      .filter { !files.contains($0) && !files.contains(PhotoNames.last($0)) }
    let result = Result(reconstruction: assigned.reconstruction, missing: missing)
    report(result, assigned, context.notes)
    let count = result.reconstruction.registered.count
    guard count >= options.minimumPhotos else {
      result.reconstruction.unregistered.forEach { context.notes.warn($0.reason) }
      throw PipelineError.tooFewCameras(
        found: count, needed: options.minimumPhotos, photos: ingested.photos.count,
        cameras: known.reconstruction.photos.count)
    }
    return result
  }

  /// Records metrics and logs which cameras are missing, scaled or rotated.
  private func report(_ result: Result, _ assigned: AssignmentBuilder, _ notes: StageNotes) {
    notes.record("registered", Double(result.reconstruction.registered.count))
    notes.record("camerasWithoutPhoto", Double(result.missing.count))
    if !result.missing.isEmpty {
      notes.warn(
        "\(result.missing.count) cameras have no photo in the folder: "
          + "\(result.missing.list(options.namesInSentence)).")
    }
    if !assigned.scaled.isEmpty {
      notes.log(
        "Cameras were scaled to the size of these photos: "
          + "\(assigned.scaled.list(options.namesInSentence)).")
    }
    if !assigned.turned.isEmpty {
      notes.log(
        "Cameras of photos in stored orientation were rotated upright: "
          + "\(assigned.turned.list(options.namesInSentence)).")
    }
  }
}

/// Looks up cameras by file name: by the full name, or by its last path component if that is
/// unique.
private struct PhotoNames {
  private var indices: [String: Int] = [:]
  /// By last path component; nil if several names have it.
  private var indicesOfLast: [String: Int?] = [:]

  init(_ names: [String]) {
    for (index, name) in names.enumerated() {
      if indices[name] == nil { indices[name] = index }
      let last = Self.last(name)
      indicesOfLast.updateValue(indicesOfLast[last] == nil ? index : nil, forKey: last)
    }
  }

  /// The last path component.
  static func last(_ name: String) -> String {
    String(name[(name.lastIndex(of: "/").map(name.index(after:)) ?? name.startIndex)...])
  }

  /// The index of the camera for a file name; nil if there is none or several.
  func index(of name: String) -> Int? { indices[name] ?? indicesOfLast[name] ?? nil }
}

/// The photos that have been assigned a camera so far.
private struct AssignmentBuilder {
  private(set) var reconstruction: Reconstruction
  private(set) var scaled: [String] = []
  private(set) var turned: [String] = []
  private var cameras: [Camera: ID<Camera>] = [:]
  /// The photo assigned to each known camera, and how the camera was fitted to it.
  private var fits: [Int: (photo: ID<Photo>, fit: CameraFit)] = [:]

  init(photos: [Photo], worldFrame: WorldFrame) {
    reconstruction = Reconstruction(
      cameras: [], photos: photos, poses: photos.map { _ in nil }, points: [],
      worldFrame: worldFrame)
  }

  /// Assigns camera and pose number `index` of `known` to `photo`.
  mutating func assignCamera(_ index: Int, of known: KnownCameras, to photo: Photo) {
    let knownPhoto = known.reconstruction.photos[index]
    let camera = known.reconstruction.camera(of: knownPhoto.id)
    guard let pose = known.reconstruction.poses[index] else {
      return leaveOut(photo, because: "its camera has no pose")
    }
    let isSizeKnown = !known.photosOfUnknownSize.contains(knownPhoto.id)
    guard let fit = CameraFit(camera, to: photo, isSizeKnown: isSizeKnown) else {
      let center = camera.principalPoint
      let size =
        isSizeKnown
        ? "is for \(camera.width) × \(camera.height) pixels"
        : "has its principal point at (\(Int(saturating: center.x)), "
          + "\(Int(saturating: center.y)))"
      return leaveOut(
        photo,
        because: "its camera \(size), but the photo has \(photo.width) × \(photo.height) pixels, "
          + "upright")
    }
    guard fit.isPossible else {
      let (focal, center) = (camera.focalLength, camera.principalPoint)
      return leaveOut(
        photo,
        because: "no photo of \(photo.width) × \(photo.height) pixels has the focal length "
          + "\(focal.x), \(focal.y) and the principal point \(center.x), \(center.y) of its "
          + "camera, in pixels; correct the camera")
    }
    if fit.isScaled { scaled.append(photo.name) }
    if fit.quarterTurns > 0 { turned.append(photo.name) }
    let id = cameras[fit.camera] ?? ID(reconstruction.cameras.count)
    if cameras[fit.camera] == nil {
      cameras[fit.camera] = id
      reconstruction.cameras.append(fit.camera)
    }
    reconstruction.photos[photo.id.index].camera = id
    reconstruction.poses[photo.id.index] = fit.pose(pose)
    fits[index] = (photo.id, fit)
  }

  /// Records that `photo` has no pose; `end` completes the sentence "NAME is not used: …".
  mutating func leaveOut(_ photo: Photo, because end: String) {
    reconstruction.unregistered.append(
      RejectedPhoto(sampleID: photo.sampleID, name: photo.name, fault: .notRegistered, end: end))
    // A photo without a pose still needs a valid camera index; it is never read.
    reconstruction.photos[photo.id.index].camera = ID(0)
  }

  /// Copies the points that at least two assigned photos observe.
  mutating func copyPoints(of known: KnownCameras) {
    reconstruction.points = known.reconstruction.points.compactMap { point in
      var point = point
      point.track = point.track.compactMap { observation in
        guard let (photo, fit) = fits[observation.photo.index] else { return nil }
        return Observation(
          photo: photo, feature: observation.feature, pixel: fit.pixel(observation.pixel))
      }.sorted { $0.photo < $1.photo }
      return point.track.count >= 2 ? point : nil
    }
  }
}
