import Kernels
import SceneModel

/// Measures how much of the object's outline in the photos a model fills.
struct OutlineCoverage {
  /// Number of photos that are looked at. Chosen: the share varies little between photos.
  var maximumPhotos = 24
  /// Number of pixels of a photo. Chosen: a share is then exact to 1 %.
  var maximumPixels = 20_000

  /// The median share over photos of the pixels inside the mask where the surface is; nil without
  /// masks.
  func run(
    _ evidence: ModelEvidence, _ reconstruction: Reconstruction, images: ImageStore,
    _ control: KernelControl
  ) throws -> Double? {
    guard images.hasMasks, let bounds = evidence.mesh.bounds else { return nil }
    let ball = Ball(
      center: SIMD3<Double>((bounds.min + bounds.max) / 2),
      radius: Double((bounds.max - bounds.min).length) / 2)
    let photos = reconstruction.registered
    let step = max(1, photos.count / maximumPhotos)
    let chosen = stride(from: 0, to: photos.count, by: step).map { photos[$0] }
    return try control.parallelMap(chosen.count) {
      try share(chosen[$0], evidence.scene, ball, reconstruction, images)
    }.compactMap(\.self).upperMedian
  }

  /// A ball around the surface.
  private struct Ball {
    var center: SIMD3<Double>
    var radius: Double
  }

  private func share(
    _ photo: ID<Photo>, _ scene: RayScene, _ ball: Ball, _ reconstruction: Reconstruction,
    _ images: ImageStore
  ) throws -> Double? {
    guard let pose = reconstruction.poses[photo.index],
      let mask = try images.pinholeMask(photo, of: reconstruction, maximumPixels: maximumPixels)
    else { return nil }
    let camera = try images.pinholeCamera(
      of: photo, in: reconstruction, maximumPixels: maximumPixels)
    let worldFromCamera = pose.inverse
    let reach = (ball.center - pose.center).length + ball.radius
    let ends = mask.pixels.indices.filter { mask.pixels[$0] >= 128 }.map { index in
      let pixel = SIMD2(Double(index % mask.width) + 0.5, Double(index / mask.width) + 0.5)
      let ray = camera.unproject(pixel)
      return SIMD3<Float>(worldFromCamera * (reach * SIMD3(ray.x, ray.y, 1)))
    }
    guard !ends.isEmpty else { return nil }
    let start = SIMD3<Float>(pose.center)
    let hits = try scene.isBlocked(
      from: [SIMD3<Float>](repeating: start, count: ends.count), to: ends, KernelControl())
    return Double(hits.count { $0 }) / Double(ends.count)
  }
}
