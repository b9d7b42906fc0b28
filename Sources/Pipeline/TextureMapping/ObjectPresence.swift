import Kernels
import SceneModel

/// Checks that the photos show the textured surface where they are aimed: in their middle.
///
/// What remains of a scene whose object could not be reconstructed may be a scrap of the
/// surroundings beside it.
struct ObjectPresence: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Side of the middle of a photo, as a share of the photo's sides. Chosen.
    var middleShare = 0.5
    /// Minimum share of the middle that the surface covers in a photo that shows it. Chosen.
    var minimumCoverage: Float = 0.005
    /// Minimum share of the photos that show the surface. Chosen.
    var minimumPhotos = 0.5
  }

  var options = Options()

  /// Records how the photos show the surface, and a concern if most of them don't. The views of
  /// `seen` are numbered as in `views`.
  func run(
    _ mesh: Mesh, seen: FaceViews, views: [ID<Photo>], _ reconstruction: Reconstruction,
    _ notes: StageNotes
  ) {
    guard !views.isEmpty else { return }
    let coverage = coverage(mesh, seen, views, reconstruction)
    let showing = coverage.count { $0 >= options.minimumCoverage }
    notes.record("middleCoverage", Double(coverage.upperMedian ?? 0))
    notes.record("photosShowingModel", Double(showing))
    guard Double(showing) < options.minimumPhotos * Double(views.count) else { return }
    notes.flagAsSuspect(
      "Only \(showing) of \(views.count) photos show the model in their middle: it may be a part "
        + "of the surroundings. Fill the frame with the object, cover what is around it with a "
        + "plain cloth, or give masks.")
  }

  /// The share of each photo's middle that the surface covers.
  private func coverage(
    _ mesh: Mesh, _ faces: FaceViews, _ views: [ID<Photo>], _ reconstruction: Reconstruction
  ) -> [Float] {
    var areas = [Float](repeating: 0, count: views.count)
    let cameras = views.map { reconstruction.camera(of: $0) }
    let poses = views.map { reconstruction.poses[$0.index] ?? .identity }
    for face in 0..<faces.faceCount {
      let center = SIMD3<Double>(mesh.center(of: mesh.triangles[face]))
      for entry in faces.entries(of: face) {
        let view = Int(entry.view)
        let size = SIMD2(Double(cameras[view].width), Double(cameras[view].height))
        let offset = cameras[view].project(poses[view] * center) / size - 0.5
        if max(abs(offset.x), abs(offset.y)) < options.middleShare / 2 { areas[view] += entry.area }
      }
    }
    let share = Float(options.middleShare * options.middleShare)
    return zip(areas, cameras).map { area, camera in
      area / (share * Float(camera.width) * Float(camera.height))
    }
  }
}
