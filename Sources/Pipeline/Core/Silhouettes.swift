import Kernels
import SceneModel

/// The silhouettes of the object in the photos that have masks: a point outside several of them is
/// not part of the object (visual hull; Laurentini, PAMI 1994).
///
/// A single photo is not sufficient, since masks contain errors and may exclude a hand in front of
/// the object. A mask is read when a point may be in its photo: for a part of a scene, those of few
/// photos are.
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
    private let readMask: @Sendable () throws -> RasterImage
    private let kept = Locked<RasterImage?>(nil)

    /// The plane of the camera and the sides of the frame, in the world frame: inward unit normals,
    /// and how far inside the origin is. A pixel of margin allows for rounding.
    private let sides: [(normal: SIMD3<Double>, offset: Double)]

    /// `readMask` returns a mask of the camera's size.
    init(
      pose: RigidTransform, camera: Camera, readMask: @escaping @Sendable () throws -> RasterImage
    ) {
      let (rotation, translation) = (pose.rotation.matrix, pose.translation)
      let (f, near) = (camera.focalLength, camera.principalPoint + 1)
      let far = SIMD2(Double(camera.width), Double(camera.height)) + 2 - near
      let normals: [SIMD3<Double>] = [
        [0, 0, 1], [f.x, 0, near.x], [0, f.y, near.y], [-f.x, 0, far.x], [0, -f.y, far.y],
      ]
      sides = normals.map(\.normalized).map { (rotation.transpose * $0, $0.dot(translation)) }
      (self.rotation, self.translation) = (rotation, translation)
      (self.camera, self.readMask) = (camera, readMask)
    }

    var mask: RasterImage {
      get throws {
        try kept.withLock { image in
          if let image { return image }
          let mask = try readMask()
          image = mask
          return mask
        }
      }
    }

    /// Counts, for each point, this view in `seen` if the point is in its frame, and in `outside`
    /// if its mask excludes the point, too.
    func count(
      _ points: [SIMD3<Double>], seen: inout [Int32], outside: inout [Int32]
    ) throws {
      let mask = try mask
      let (width, height) = (mask.width, mask.height)
      mask.pixels.withUnsafeBufferPointer { pixels in
        for index in points.indices {
          let p = rotation * points[index] + translation
          guard p.z > 0 else { continue }
          let pixel = SIMD2(p.x, p.y) / p.z * camera.focalLength + camera.principalPoint
          guard pixel.x >= 0, pixel.y >= 0, pixel.x < Double(width), pixel.y < Double(height)
          else { continue }
          seen[index] += 1
          if pixels[Int(pixel.y) * width + Int(pixel.x)] < RasterImage.leastMarked {
            outside[index] += 1
          }
        }
      }
    }

    /// False if nothing of a ball is in the frame.
    func mayShow(ballAt center: SIMD3<Double>, radius: Double) -> Bool {
      sides.allSatisfy { $0.normal.dot(center) + $0.offset > -radius }
    }
  }

  /// Share of the registered photos that have a mask.
  let share: Double
  private let options: Options
  private let views: [View]

  /// Nil if no registered photo has a mask.
  package init?(
    _ reconstruction: Reconstruction, images: ImageStore, options: Options = Options()
  ) throws {
    guard images.hasMasks else { return nil }
    let registered = reconstruction.registered
    var scene = reconstruction
    scene.points = []
    views = try registered.compactMap { [scene] photo -> View? in
      guard let pose = scene.poses[photo.index], images.hasMask(photo) else { return nil }
      let camera = try images.pinholeCamera(
        of: photo, in: scene, maximumPixels: options.maximumPixels)
      let margin = max(1, options.margin * Double(max(camera.width, camera.height)))
      return View(pose: pose, camera: camera) {
        let mask = try images.pinholeMask(photo, of: scene, maximumPixels: options.maximumPixels)
        guard let mask else { throw KernelError.invalidArgument("a photo has lost its mask") }
        return try mask.dilated(by: Int(margin.rounded()))
      }
    }
    guard !views.isEmpty else { return nil }
    share = Double(views.count) / Double(registered.count)
    self.options = options
  }

  /// Reads all masks: their files may change.
  func readMasks(_ control: KernelControl) throws {
    _ = try control.parallelMap(views.count) { [views] in _ = try views[$0].mask }
  }

  /// Whether a point may be part of the object.
  func isInside(_ point: SIMD3<Float>) throws -> Bool {
    try areInside([SIMD3<Double>(point)], views(near: [point]))[0]
  }

  /// The same for several points that no other views have in their frame.
  private func areInside(_ points: [SIMD3<Double>], _ views: [View]) throws -> [Bool] {
    var seen = [Int32](repeating: 0, count: points.count)
    var outside = seen
    for view in views { try view.count(points, seen: &seen, outside: &outside) }
    return zip(seen, outside).map { seen, outside in
      outside < options.minimumPhotos
        || Double(outside) < options.minimumShare * Double(seen)
    }
  }

  /// For each point, whether it may be part of the object. Consecutive points are usually near each
  /// other: each block of them is looked up in the views whose frame it may be in.
  func areInside(_ points: [SIMD3<Float>], _ control: KernelControl) throws -> [Bool] {
    let size = 256  // Points per block. Chosen: few compared with those of a photo.
    return try control.parallelMap(points.count, inUnitsOf: size) {
      let own = points[$0]
      return try areInside(own.map { SIMD3<Double>($0) }, views(near: own))
    }
  }

  /// The views whose frame one of the points may be in.
  private func views(near points: ArraySlice<SIMD3<Float>>) -> [View] {
    guard let bounds = Mesh(positions: points.filter(\.isFinite)).bounds else { return [] }
    let (low, high) = (SIMD3<Double>(bounds.min), SIMD3<Double>(bounds.max))
    let radius = (high - low).length / 2
    return views.filter { $0.mayShow(ballAt: (low + high) / 2, radius: radius) }
  }
}
