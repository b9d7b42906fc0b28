import Kernels
import SceneModel

/// The outlines of the object in the photos that have masks: what several of them leave out is not of
/// the object (the visual hull: Laurentini, PAMI 1994).
///
/// One photo alone doesn't rule, since masks have faults, and may leave out a hand before the object.
package struct Silhouettes: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Pixels of a mask.
    package var maximumPixels = 500_000
    /// How far beyond its masks an object may reach, as a fraction of a photo's longer side: what poses
    /// and hand-made outlines may be wrong by.
    package var margin = 0.003
    /// Photos that must leave a point out for it not to be of the object.
    package var minimumPhotos = 2
    /// The same as a share of the photos with masks that have the point in their frame.
    package var minimumShare = 0.15

    package init() {}
  }

  private struct View: Sendable {
    var rotation: Matrix3
    var translation: SIMD3<Double>
    var camera: Camera
    /// Widened by the margin.
    var mask: RasterImage
  }

  /// Share of the registered photos that have a mask.
  let share: Double
  private let options: Options
  private let views: [View]

  /// Nil where no registered photo has a mask.
  package init?(
    _ reconstruction: Reconstruction, images: ImageStore, options: Options = Options()
  ) throws {
    guard images.hasMasks else { return nil }
    let registered = reconstruction.registered
    views = try registered.compactMap { photo in
      guard let pose = reconstruction.poses[photo.index],
        let mask = try images.pinholeMask(
          photo, of: reconstruction, maximumPixels: options.maximumPixels)
      else { return nil }
      let camera = try images.pinholeCamera(
        of: photo, in: reconstruction, maximumPixels: options.maximumPixels)
      let margin = max(1, options.margin * Double(max(mask.width, mask.height)))
      return View(
        rotation: pose.rotation.matrix, translation: pose.translation, camera: camera,
        mask: try mask.dilated(by: Int(margin.rounded())))
    }
    guard !views.isEmpty else { return nil }
    share = Double(views.count) / Double(registered.count)
    self.options = options
  }

  /// Whether a point may be of the object.
  func isInside(_ point: SIMD3<Double>) -> Bool {
    var (seen, outside) = (0, 0)
    for view in views {
      let p = view.rotation * point + view.translation
      guard p.z > 0 else { continue }
      let place = SIMD2(p.x, p.y) / p.z * view.camera.focalLength + view.camera.principalPoint
      guard place.x >= 0, place.y >= 0, place.x < Double(view.mask.width),
        place.y < Double(view.mask.height)
      else { continue }
      seen += 1
      if !view.mask.isMarked(at: place) { outside += 1 }
    }
    return outside < options.minimumPhotos
      || Double(outside) < options.minimumShare * Double(seen)
  }

  /// Whether each of some points may be of the object.
  func areInside(_ points: [SIMD3<Float>], _ control: KernelControl) throws -> [Bool] {
    let chunk = 8192
    let parts = try control.parallelMap((points.count + chunk - 1) / chunk) { part in
      points[part * chunk..<min(points.count, (part + 1) * chunk)]
        .map { isInside(SIMD3<Double>($0)) }
    }
    return parts.flatMap { $0 }
  }
}
