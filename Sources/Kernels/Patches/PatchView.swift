import CKernels
import SceneModel

/// A view prepared for patch stereo: luma and colors at fixed addresses, and its camera.
package final class PatchView: @unchecked Sendable {
  package let photo: ID<Photo>
  /// Pinhole camera of the view, without distortion.
  package let camera: Camera
  /// The pose of the photo.
  package let cameraFromWorld: RigidTransform
  /// Pixels.
  package let width: Int
  package let height: Int
  /// Standard deviation of the luma noise in gray levels.
  package let noise: Float
  // Written only in `init`, so that sharing between threads is safe.
  let luma: UnsafeMutablePointer<UInt8>
  /// Nil in a halved view: colors are taken from the full one.
  let rgb: UnsafeMutablePointer<UInt8>?

  /// A copy of an image in memory; `noise` is estimated if nil.
  package convenience init(_ view: PinholeView, noise: Float? = nil) {
    self.init(
      photo: view.photo, camera: view.camera, cameraFromWorld: view.cameraFromWorld,
      width: view.image.width, height: view.image.height, noise: noise
    ) { rgb in
      view.image.pixels.withUnsafeBytes { rgb.copyMemory(from: $0) }
    }
  }

  /// A view whose RGB pixels `fill` writes to the given buffer.
  package init(
    photo: ID<Photo>, camera: Camera, cameraFromWorld: RigidTransform, width: Int, height: Int,
    noise: Float? = nil, fill: (UnsafeMutableRawBufferPointer) throws -> Void
  ) rethrows {
    self.photo = photo
    self.camera = camera
    self.cameraFromWorld = cameraFromWorld
    (self.width, self.height) = (width, height)
    let (luma, rgb) = (
      UnsafeMutablePointer<UInt8>.allocate(capacity: width * height),
      UnsafeMutablePointer<UInt8>.allocate(capacity: 3 * width * height)
    )
    (self.luma, self.rgb) = (luma, rgb)
    do {
      try fill(UnsafeMutableRawBufferPointer(start: rgb, count: 3 * width * height))
    } catch {
      luma.deallocate()
      rgb.deallocate()
      throw error
    }
    // Rec. 601 in 8-bit fixed point.
    for i in 0..<width * height {
      let (r, g, b) = (UInt32(rgb[3 * i]), UInt32(rgb[3 * i + 1]), UInt32(rgb[3 * i + 2]))
      luma[i] = UInt8(truncatingIfNeeded: (77 &* r &+ 150 &* g &+ 29 &* b &+ 128) >> 8)
    }
    self.noise = noise ?? ck_patches_noise(luma, Int32(width), Int32(height))
  }

  /// The view at half the resolution, luma only.
  package func halved() -> PatchView { PatchView(halving: self) }

  private init(halving view: PatchView) {
    (photo, cameraFromWorld) = (view.photo, view.cameraFromWorld)
    (width, height) = (view.width / 2, view.height / 2)
    var camera = view.camera
    (camera.width, camera.height) = (width, height)
    camera.focalLength *= 0.5
    camera.principalPoint *= 0.5
    self.camera = camera
    // Averaging four pixels halves the noise.
    noise = view.noise / 2
    rgb = nil
    luma = .allocate(capacity: width * height)
    ck_patches_halve(luma, view.luma, Int32(view.width), Int32(view.height))
  }

  /// The RGB pixels, empty for a halved view; valid as long as this object lives.
  package var rgbBytes: UnsafeRawBufferPointer {
    UnsafeRawBufferPointer(start: rgb, count: rgb == nil ? 0 : 3 * width * height)
  }

  deinit {
    luma.deallocate()
    rgb?.deallocate()
  }

  /// The C view, valid as long as this object lives.
  var raw: ck_patch_view {
    let r = cameraFromWorld.rotation.matrix.elements
    let t = cameraFromWorld.translation
    return ck_patch_view(
      width: Int32(width), height: Int32(height), luma: luma, fx: camera.focalLength.x,
      fy: camera.focalLength.y, cx: camera.principalPoint.x, cy: camera.principalPoint.y,
      rotation: (r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]),
      translation: (t.x, t.y, t.z), noise: noise)
  }
}
