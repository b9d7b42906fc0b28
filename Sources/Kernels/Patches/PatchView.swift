import CKernels
import SceneModel

/// A view prepared for patch stereo: its camera, and its luma and colors at fixed addresses.
package final class PatchView: Sendable {
  /// The photo that the view was made from.
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
  let luma: FrozenArray<UInt8>
  /// Nil in a halved view: colors are taken from the full one.
  let rgb: FrozenArray<UInt8>?

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
    let rgb = try FrozenArray<UInt8>(count: 3 * width * height) {
      try fill(UnsafeMutableRawBufferPointer($0))
    }
    self.rgb = rgb
    luma = FrozenArray(count: width * height) { luma in
      let rgb = rgb.elements
      // Rec. 601 in 8-bit fixed point.
      for i in 0..<width * height {
        let (r, g, b) = (UInt32(rgb[3 * i]), UInt32(rgb[3 * i + 1]), UInt32(rgb[3 * i + 2]))
        luma[i] = UInt8(truncatingIfNeeded: (77 &* r &+ 150 &* g &+ 29 &* b &+ 128) >> 8)
      }
    }
    self.noise = noise ?? ck_patches_noise(luma.base, Int32(width), Int32(height))
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
    // Averaging four pixels halves the standard deviation of the noise.
    noise = view.noise / 2
    rgb = nil
    luma = FrozenArray(count: width * height) {
      ck_patches_halve(view.luma.base, Int32(view.width), Int32(view.height), $0.baseAddress)
    }
  }

  /// The RGB pixels, empty for a halved view; valid as long as this object lives.
  package var rgbBytes: UnsafeRawBufferPointer {
    rgb.map { UnsafeRawBufferPointer($0.elements) } ?? UnsafeRawBufferPointer(start: nil, count: 0)
  }

  /// The C view, valid as long as this object lives.
  var raw: ck_patch_view {
    ck_patch_view(
      camera: ck_camera(camera, width: width, height: height),
      camera_from_world: ck_pose(cameraFromWorld), luma: luma.base, noise: noise)
  }
}
