import Foundation
import Kernels
import SceneModel

/// A scene with known surface, cameras and light, rendered by ray casting: photos for tests and for
/// the demo.
///
/// World: right-handed, +y up, meters. Surfaces are Lambertian and the light is fixed, so that a
/// point has the same color in every photo except for sensor noise.
package struct RenderedScene: Sendable {
  /// A mesh with vertex normals, and its texture.
  package struct Surface: Sendable {
    package var mesh: Mesh
    package var texture: any SurfaceTexture
    /// Maps a point to where the texture is looked up, so that the texture of a surface that moves
    /// moves with it; nil looks it up at the point itself.
    package var textureFromWorld: RigidTransform?

    package init(
      mesh: Mesh, texture: any SurfaceTexture, textureFromWorld: RigidTransform? = nil
    ) {
      self.mesh = mesh
      self.texture = texture
      self.textureFromWorld = textureFromWorld
    }

    func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
      guard let textureFromWorld else { return texture.color(at: point, footprint: footprint) }
      let place = SIMD3<Float>(textureFromWorld * SIMD3<Double>(point))
      return texture.color(at: place, footprint: footprint)
    }
  }

  /// The light of a scene: radiance per albedo.
  package struct Lighting: Sendable {
    /// From all sides, on a vertical surface. Chosen.
    package var ambient: Float = 0.36
    /// What a surface that faces up receives beyond `ambient`; one that faces down receives as
    /// much less. Chosen.
    package var sky: Float = 0.14
    /// From the direction of the sun, with shadows. Chosen.
    package var sun: Float = 0.62
    /// The unit vector to the sun. Chosen.
    package var sunDirection = SIMD3<Float>(0.45, 0.8, 0.5).normalized

    package init() {}
  }

  /// A plain background without detail behind all surfaces.
  package struct Backdrop: Sendable {
    /// The light from below and from above, linear RGB. Chosen.
    package var low: SIMD3<Float> = [0.10, 0.11, 0.12]
    package var high: SIMD3<Float> = [0.22, 0.24, 0.27]

    package init() {}

    package init(low: SIMD3<Float>, high: SIMD3<Float>) { (self.low, self.high) = (low, high) }
  }

  /// The surface to be reconstructed, and the reference to score against.
  package let object: Mesh
  /// The camera of all photos.
  package let camera: Camera
  /// `cameraFromWorld` by photo.
  package let poses: [RigidTransform]
  /// Standard deviation of the sensor noise in gray levels. Chosen.
  package var noise = 1.2
  /// Rays per pixel and direction: 2 casts four rays. Chosen.
  package var samplesPerSide = 2
  /// A lens, an exposure per photo, and adaptive sampling at edges; nil casts the same rays
  /// everywhere and applies no photographic effects.
  package var photography: Photography?
  /// Occludes a part of the object in some photos.
  package var intruder: Intruder?
  package var lighting = Lighting()
  package var backdrop = Backdrop()

  /// The object, then its surroundings.
  package let surfaces: [Surface]
  /// Intersects rays with all surfaces.
  package let caster: RayCaster
  /// The surface of each of the caster's triangles, and the triangle's index in it.
  package let parts: [(surface: Int, triangle: Int)]
  package let seed: UInt64

  /// `object` is the surface to be reconstructed, `surroundings` are the other visible surfaces.
  package init(
    object: Surface, surroundings: [Surface], camera: Camera, poses: [RigidTransform],
    seed: UInt64 = 1
  ) {
    self.object = object.mesh
    self.camera = camera
    self.poses = poses
    self.seed = seed
    surfaces = [object] + surroundings
    var corners: [(SIMD3<Float>, SIMD3<Float>, SIMD3<Float>)] = []
    var parts: [(surface: Int, triangle: Int)] = []
    for (index, surface) in surfaces.enumerated() {
      let p = surface.mesh.positions
      for (number, t) in surface.mesh.triangles.enumerated() {
        corners.append((p[Int(t.a)], p[Int(t.b)], p[Int(t.c)]))
        parts.append((index, number))
      }
    }
    caster = RayCaster(corners)
    self.parts = parts
  }

  /// Renders a photo: RGB, sRGB-encoded.
  package func photo(
    _ index: Int, _ control: KernelControl = KernelControl()
  ) throws -> RasterImage {
    if let photography { return try photo(index, taken: photography, control) }
    let rows = try control.parallelMap(camera.height) { row in renderRow(row, index) }
    return RasterImage(
      width: camera.width, height: camera.height, channels: 3, pixels: rows.flatMap { $0 })
  }

  /// All photos in order.
  package func photos(_ control: KernelControl = KernelControl()) throws -> [RasterImage] {
    try poses.indices.map { try photo($0, control) }
  }

  /// The file name of a photo: `view_00.jpg`.
  package static func name(_ index: Int) -> String {
    "view_\(index < 10 ? "0" : "")\(index).jpg"
  }

  /// The ray of photo `index` through a pixel. Its direction has depth 1 in the camera frame, so
  /// that the distance of a hit is its depth.
  package func ray(
    through pixel: SIMD2<Double>, of index: Int
  ) -> (origin: SIMD3<Float>, direction: SIMD3<Float>) {
    let ray = camera.unproject(pixel)
    let direction = poses[index].rotation.conjugate * SIMD3(ray.x, ray.y, 1)
    return (SIMD3<Float>(poses[index].center), SIMD3<Float>(direction))
  }

  private func renderRow(_ row: Int, _ index: Int) -> [UInt8] {
    var generator = SplitMix64(
      seed: seed &* 1_000_003 &+ UInt64(index) &* 65_537 &+ UInt64(row))
    var pixels: [UInt8] = []
    pixels.reserveCapacity(camera.width * 3)
    for column in 0..<camera.width {
      var sum = SIMD3<Float>.zero
      for sample in 0..<samplesPerSide * samplesPerSide {
        let offset = SIMD2(Double(sample % samplesPerSide), Double(sample / samplesPerSide)) + 0.5
        let pixel = SIMD2(Double(column), Double(row)) + offset / Double(samplesPerSide)
        sum += sight(through: pixel, of: index).radiance
      }
      let linear = sum / Float(samplesPerSide * samplesPerSide)
      let noise = generator.normal3() * self.noise
      for channel in 0..<3 {
        let encoded = 255 * Self.encode(Double(linear[channel])) + noise[channel]
        pixels.append(UInt8(min(max(encoded.rounded(), 0), 255)))
      }
    }
    return pixels
  }

  /// The light and the surface that photo `index` shows at a pixel.
  func sight(through pixel: SIMD2<Double>, of index: Int) -> Sight {
    let ray = ray(through: pixel, of: index)
    let behind = sight(along: ray)
    guard let intruder, let center = intruder.center(in: index),
      let before = intruder.sight(
        from: ray.origin, along: ray.direction,
        center: SIMD3<Float>(poses[index].inverse * SIMD3<Double>(center)),
        footprint: 1 / Float(camera.focalLength.x)),
      before.depth < behind.depth
    else { return behind }
    return before
  }

  /// The light that arrives along a ray as `ray(through:of:)` returns it, per channel, linear.
  package func radiance(along ray: (origin: SIMD3<Float>, direction: SIMD3<Float>)) -> SIMD3<Float>
  {
    sight(along: ray).radiance
  }

  private func sight(along ray: (origin: SIMD3<Float>, direction: SIMD3<Float>)) -> Sight {
    guard let hit = caster.hit(from: ray.origin, along: ray.direction) else {
      let height = 0.5 + 0.5 * ray.direction.normalized.y
      return Sight(radiance: backdrop.low + (backdrop.high - backdrop.low) * height)
    }
    let part = parts[hit.triangle]
    let surface = surfaces[part.surface]
    let t = surface.mesh.triangles[part.triangle]
    let n = surface.mesh.normals
    let normal =
      (n[Int(t.a)] * (1 - hit.u - hit.v) + n[Int(t.b)] * hit.u + n[Int(t.c)] * hit.v).normalized
    let point = ray.origin + ray.direction * hit.distance
    let facing = max(0.2, abs(normal.dot(ray.direction.normalized)))
    let footprint = hit.distance / Float(camera.focalLength.x) / facing
    let albedo = surface.color(at: point, footprint: footprint)
    let sun = max(0, normal.dot(lighting.sunDirection))
    let isLit =
      sun > 0 && !caster.isBlocked(from: point + normal * 1e-3, along: lighting.sunDirection)
    let ambient = lighting.ambient + lighting.sky * normal.y
    return Sight(
      radiance: albedo * (ambient + (isLit ? lighting.sun * sun : 0)),
      depth: hit.distance, normal: normal, surface: part.surface, isLit: isLit)
  }

  /// sRGB transfer function.
  package static func encode(_ linear: Double) -> Double {
    let value = min(max(linear, 0), 1)
    return value <= 0.003_130_8 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055
  }
}
