import Foundation
import SceneModel

/// A textured ball of radius 1 that floats above a textured floor, photographed along an arc, with
/// known depth at each pixel. Beyond the floor is a textureless sky.
package struct RaycastScene: Sendable {
  package struct Options: Sendable {
    package var viewCount = 5
    package var width = 160
    package var height = 120
    /// Angle between neighboring views in degrees.
    package var stepDegrees = 9.0
    package var hasBall = true
    /// The y coordinate of the floor.
    package var floor = -1.2
    /// Distance from the center to the edge of the floor.
    package var floorExtent = 4.0
    /// Renders the floor and the ball in one color.
    package var isUniform = false

    package init() {}
  }

  package let options: Options
  package let views: [PinholeView]
  /// Points of the surfaces, each with at least two photos that observe it.
  package let reconstruction: Reconstruction

  package init(_ options: Options = Options()) {
    self.options = options
    let camera = Camera(
      width: options.width, height: options.height,
      focalLength: SIMD2(repeating: 1.1 * Double(options.width)), calibration: .refined)
    let poses = (0..<options.viewCount).map { index in
      let middle = Double(options.viewCount - 1) / 2
      let angle = (Double(index) - middle) * options.stepDegrees * .pi / 180
      return RigidTransform.lookingAt(
        [0, -0.2, 0], from: [4.5 * sin(angle), 1.2 + 0.2 * cos(5 * angle), 4.5 * cos(angle)])
    }
    views = poses.enumerated().map { index, pose in
      Self.render(ID(index), camera, pose, options)
    }
    reconstruction = Self.reconstruct(camera, poses, options)
  }

  /// The depth (z in the camera frame) of the pixel at column `x`, row `y`; nil for the sky.
  package func depth(_ view: Int, _ x: Int, _ y: Int) -> Double? {
    let (ray, pose) = (self.ray(view, x, y), views[view].cameraFromWorld)
    guard let hit = Self.hit(from: pose.center, along: ray, options) else { return nil }
    return (pose * hit.point).z
  }

  /// The outward unit normal at a pixel; nil for the sky.
  package func normal(_ view: Int, _ x: Int, _ y: Int) -> SIMD3<Double>? {
    Self.hit(from: views[view].cameraFromWorld.center, along: ray(view, x, y), options)?.normal
  }

  /// The distance of a point from the nearest surface.
  package func distance(to point: SIMD3<Double>) -> Double {
    let floor = abs(point.y - options.floor)
    return options.hasBall ? min(floor, abs(point.length - 1)) : floor
  }

  private func ray(_ view: Int, _ x: Int, _ y: Int) -> SIMD3<Double> {
    let view = views[view]
    return Self.ray(view.camera, view.cameraFromWorld, SIMD2(Double(x) + 0.5, Double(y) + 0.5))
  }
}

extension RaycastScene {
  private typealias Hit = (point: SIMD3<Double>, normal: SIMD3<Double>)

  private static func ray(
    _ camera: Camera, _ pose: RigidTransform, _ pixel: SIMD2<Double>
  ) -> SIMD3<Double> {
    let p = camera.unproject(pixel)
    return (pose.rotation.conjugate * SIMD3(p.x, p.y, 1)).normalized
  }

  private static func hit(
    from origin: SIMD3<Double>, along ray: SIMD3<Double>, _ options: Options
  ) -> Hit? {
    let b = origin.dot(ray)
    let discriminant = b * b - (origin.squaredLength - 1)
    if options.hasBall, discriminant > 0, -b - discriminant.squareRoot() > 0 {
      let point = origin + (-b - discriminant.squareRoot()) * ray
      return (point, point.normalized)
    }
    let t = (options.floor - origin.y) / ray.y
    guard t > 0, t.isFinite else { return nil }
    let point = origin + t * ray
    let isInside = max(abs(point.x), abs(point.z)) < options.floorExtent
    return isInside ? (point, [0, 1, 0]) : nil
  }

  /// The mean of 2 × 2 rays per pixel.
  private static func render(
    _ photo: ID<Photo>, _ camera: Camera, _ pose: RigidTransform, _ options: Options
  ) -> PinholeView {
    var image = RasterImage(width: camera.width, height: camera.height, channels: 3)
    let offsets: [SIMD2<Double>] = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]
    for y in 0..<camera.height {
      for x in 0..<camera.width {
        var sum = SIMD3<Double>.zero
        for offset in offsets {
          let ray = ray(camera, pose, SIMD2(Double(x), Double(y)) + offset)
          let point = hit(from: pose.center, along: ray, options)?.point
          sum += point.map { color($0, options) } ?? [170, 180, 200]
        }
        for channel in 0..<3 {
          image.pixels[(y * camera.width + x) * 3 + channel] = UInt8(sum[channel] / 4 + 0.5)
        }
      }
    }
    return PinholeView(photo: photo, image: image, camera: camera, cameraFromWorld: pose)
  }

  private static func color(_ p: SIMD3<Double>, _ options: Options) -> SIMD3<Double> {
    guard !options.isUniform else { return [120, 120, 120] }
    let coarse = noise(p * 4, 1), middle = noise(p * 11, 2), fine = noise(p * 23, 3)
    let gray = 128 + 210 * (0.35 * coarse + 0.35 * middle + 0.3 * fine - 0.5)
    return SIMD3(gray, 0.9 * gray + 10, 0.8 * gray + 20)
      .clamped(lowerBound: SIMD3(repeating: 0), upperBound: SIMD3(repeating: 255))
  }

  /// Value noise, 0…1.
  private static func noise(_ p: SIMD3<Double>, _ seed: UInt32) -> Double {
    let cell = p.rounded(.down)
    let f = p - cell
    let s = f * f * (3 - 2 * f)
    var value = 0.0
    for corner in 0..<8 {
      let d = SIMD3(Double(corner & 1), Double(corner >> 1 & 1), Double(corner >> 2))
      var hash = seed &* 0xC2B2_AE3D
      for axis in 0..<3 {
        hash = (hash ^ UInt32(truncatingIfNeeded: Int(cell[axis] + d[axis]))) &* 0x9E37_79B1
        hash ^= hash >> 15
      }
      let weight = d * s + (1 - d) * (1 - s)
      value += weight.x * weight.y * weight.z * Double(hash >> 8) / Double(1 << 24)
    }
    return value
  }

  /// Every 12th pixel of the middle view as a sparse point, observed by the photos in which it is
  /// not occluded.
  private static func reconstruct(
    _ camera: Camera, _ poses: [RigidTransform], _ options: Options
  ) -> Reconstruction {
    var points: [ScenePoint] = []
    let pose = poses[poses.count / 2]
    for y in stride(from: 4, to: camera.height, by: 12) {
      for x in stride(from: 4, to: camera.width, by: 12) {
        let ray = ray(camera, pose, SIMD2(Double(x) + 0.5, Double(y) + 0.5))
        guard let point = hit(from: pose.center, along: ray, options)?.point else { continue }
        let track = poses.indices.compactMap { index -> Observation? in
          let (center, pixel) = (poses[index].center, camera.project(poses[index] * point))
          let seen = hit(from: center, along: (point - center).normalized, options)?.point
          let isInside =
            pixel.x > 0 && pixel.y > 0 && pixel.x < Double(camera.width)
            && pixel.y < Double(camera.height)
          guard isInside, let seen, (seen - point).length < 1e-6 else { return nil }
          return Observation(photo: ID(index), feature: Int32(points.count), pixel: pixel)
        }
        if track.count >= 2 { points.append(ScenePoint(position: point, track: track)) }
      }
    }
    let photos = poses.indices.map { index in
      Photo(
        id: ID(index), sampleID: index, name: "photo\(index).jpg",
        url: URL(fileURLWithPath: "/photo\(index).jpg"), width: camera.width,
        height: camera.height, orientation: 1, camera: ID<Camera>(0))
    }
    return Reconstruction(
      cameras: [camera], photos: photos, poses: poses.map { $0 }, points: points)
  }
}
