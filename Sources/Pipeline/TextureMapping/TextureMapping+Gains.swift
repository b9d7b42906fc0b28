import Kernels
import SceneModel

extension TextureMapping {
  /// The gain of each photo, from a surface of all that the photos show: with these, its parts have
  /// the same colors where they meet, though each is textured by itself.
  func gains(
    on surface: Mesh, _ reconstruction: Reconstruction, images: ImageStore, _ context: StageContext
  ) throws -> [ExposureGain] {
    var gains = [ExposureGain](repeating: .none, count: reconstruction.photos.count)
    guard !surface.triangles.isEmpty else { return gains }
    let views = reconstruction.registered
    let scene = try RayScene(surface, context.part(from: 0, to: 0.1).control)
    let seen = try ViewObservation(options: options.observation).run(
      scene, views: views, source: ViewSource(reconstruction, images: images),
      context.part(from: 0.1, to: 0.8))
    let estimated = try ExposureCompensation(options: options.exposure)
      .run(seen, viewCount: views.count, context.part(from: 0.8, to: 1))
    for (photo, gain) in zip(views, estimated) { gains[photo.index] = gain }
    return gains
  }
}
