import Kernels
import SceneModel

/// Photos of an object that rotates in front of a static camera: everything except the object is
/// identical in all of them.
package struct TurntablePhotos: Sendable {
  package let photos: [RasterImage]
  /// The masks of the object.
  package let masks: [RasterImage]

  /// Composites the object of `scene` over a textured background.
  package init(_ scene: RenderedScene, _ control: KernelControl = KernelControl()) throws {
    let background = TexturePattern.image(
      width: scene.camera.width, height: scene.camera.height, seed: 4711)
    let masks = try control.parallelMap(scene.poses.count) { scene.mask($0) }
    self.masks = masks
    photos = zip(try scene.photos(control), masks).map { photo, mask in
      var photo = photo
      for pixel in mask.pixels.indices where mask.pixels[pixel] == 0 {
        for channel in 3 * pixel..<3 * pixel + 3 {
          photo.pixels[channel] = background.pixels[channel]
        }
      }
      return photo
    }
  }
}
