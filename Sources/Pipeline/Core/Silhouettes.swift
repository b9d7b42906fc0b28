import Kernels
import SceneModel

/// The silhouettes of the object in the photos that have masks: a point outside several of them is
/// not part of the object (visual hull; Laurentini, PAMI 1994).
///
/// A single photo is not sufficient, since masks contain errors and may exclude a hand in front of
/// the object.
package struct Silhouettes: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// The maximum number of pixels of a mask. Chosen.
    package var maximumPixels = 500_000
    /// The margin around masks, as a fraction of a photo's longer side: the tolerance for errors of
    /// poses and of hand-drawn outlines. Chosen.
    package var margin = 0.003
    /// The minimum number of photos whose masks must exclude a point to reject it. Chosen: a single
    /// mask may be wrong.
    package var minimumPhotos = 2
    /// The same, as a share of the photos with masks that contain the point in their frame. Chosen.
    package var minimumShare = 0.15

    package init() {}
  }

  /// A class, because millions of points are looked up in every view: a structure would be copied.
  private final class View: Sendable {
    let rotation: Matrix3
    let translation: SIMD3<Double>
    let camera: Camera
    /// Dilated by the margin.
    let mask: RasterImage

    init(pose: RigidTransform, camera: Camera, mask: RasterImage) {
      (rotation, translation) = (pose.rotation.matrix, pose.translation)
      (self.camera, self.mask) = (camera, mask)
    }

    /// False if no point of a box is in the frame; a pixel of margin allows for rounding.
    func mayShow(_ box: Box) -> Bool {
      let corners = box.corners.map { rotation * $0 + translation }
      let (f, near) = (camera.focalLength, camera.principalPoint + 1)
      let far = SIMD2(Double(mask.width), Double(mask.height)) + 2 - near
      // The normals of the camera's plane and of the frame's sides, all inward.
      let sides: [SIMD3<Double>] = [
        [0, 0, 1], [f.x, 0, near.x], [0, f.y, near.y], [-f.x, 0, far.x], [0, -f.y, far.y],
      ]
      return sides.allSatisfy { side in corners.contains { side.dot($0) > 0 } }
    }
  }

  /// The box of some points.
  private struct Box {
    let corners: [SIMD3<Double>]

    init(_ points: ArraySlice<SIMD3<Float>>) {
      var (low, high) = (SIMD3<Float>(repeating: .infinity), -SIMD3<Float>(repeating: .infinity))
      for point in points where point.isFinite {
        (low, high) = (pointwiseMin(low, point), pointwiseMax(high, point))
      }
      corners = (0..<8).map { corner in
        SIMD3<Double>(
          low.replacing(with: high, where: [corner & 1 != 0, corner & 2 != 0, corner & 4 != 0]))
      }
    }
  }

  /// Share of the registered photos that have a mask.
  let share: Double
  private let options: Options
  private let views: [View]

  /// Nil if no registered photo has a mask.
  package init?(
    _ reconstruction: Reconstruction, images: ImageStore, options: Options = Options(),
    _ control: KernelControl = KernelControl()
  ) throws {
    guard images.hasMasks else { return nil }
    let registered = reconstruction.registered
    views = try control.parallelMap(registered.count) { index -> View? in
      let photo = registered[index]
      guard let pose = reconstruction.poses[photo.index],
        let mask = try images.pinholeMask(
          photo, of: reconstruction, maximumPixels: options.maximumPixels)
      else { return nil }
      let camera = try images.pinholeCamera(
        of: photo, in: reconstruction, maximumPixels: options.maximumPixels)
      let margin = max(1, options.margin * Double(max(mask.width, mask.height)))
      return View(
        pose: pose, camera: camera, mask: try mask.dilated(by: Int(margin.rounded())))
    }.compactMap { $0 }
    guard !views.isEmpty else { return nil }
    share = Double(views.count) / Double(registered.count)
    self.options = options
  }

  /// Whether a point may be part of the object.
  func isInside(_ point: SIMD3<Double>) -> Bool { isInside(point, views) }

  /// The same, when only some views may have the point in their frame.
  private func isInside(_ point: SIMD3<Double>, _ views: [View]) -> Bool {
    var (seen, outside) = (0, 0)
    for view in views {
      let p = view.rotation * point + view.translation
      guard p.z > 0 else { continue }
      let pixel = SIMD2(p.x, p.y) / p.z * view.camera.focalLength + view.camera.principalPoint
      guard pixel.x >= 0, pixel.y >= 0, pixel.x < Double(view.mask.width),
        pixel.y < Double(view.mask.height)
      else { continue }
      seen += 1
      if !view.mask.isMarked(at: pixel) { outside += 1 }
    }
    return outside < options.minimumPhotos
      || Double(outside) < options.minimumShare * Double(seen)
  }

  /// For each point, whether it may be part of the object. Consecutive points are near each other:
  /// each block of them is looked up in the views whose frame it may be in.
  func areInside(_ points: [SIMD3<Float>], _ control: KernelControl) throws -> [Bool] {
    let size = 256  // Points per block. Chosen: about the views' number of large sets.
    let blocks = (points.count + size - 1) / size
    return try control.parallelMap(blocks, inUnitsOf: 32) { block in
      let own = points[block * size..<min((block + 1) * size, points.count)]
      let box = Box(own)
      let near = views.filter { $0.mayShow(box) }
      return own.map { isInside(SIMD3<Double>($0), near) }
    }.flatMap(\.self)
  }
}
