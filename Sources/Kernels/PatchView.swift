import CKernels
import SceneModel

/// A view ready for patch stereo: its luma and colours at fixed addresses, and its camera.
package final class PatchView: @unchecked Sendable {
  package let photo: ID<Photo>
  package let camera: Camera
  package let cameraFromWorld: RigidTransform
  package let width: Int
  package let height: Int
  // Written in `init` only, which makes sharing between threads safe.
  let luma: UnsafeMutablePointer<UInt8>
  let rgb: UnsafeMutablePointer<UInt8>

  /// The view as it is in memory.
  package convenience init(_ view: PinholeView) {
    self.init(
      photo: view.photo, camera: view.camera, cameraFromWorld: view.cameraFromWorld,
      width: view.image.width, height: view.image.height
    ) { rgb in
      view.image.pixels.withUnsafeBytes { rgb.copyMemory(from: $0) }
    }
  }

  /// A view whose pixels, RGB, `fill` puts into the buffer that it is given.
  package init(
    photo: ID<Photo>, camera: Camera, cameraFromWorld: RigidTransform, width: Int, height: Int,
    fill: (UnsafeMutableRawBufferPointer) throws -> Void
  ) rethrows {
    self.photo = photo
    self.camera = camera
    self.cameraFromWorld = cameraFromWorld
    (self.width, self.height) = (width, height)
    luma = .allocate(capacity: width * height)
    rgb = .allocate(capacity: 3 * width * height)
    try fill(UnsafeMutableRawBufferPointer(start: rgb, count: 3 * width * height))
    // Rec. 601 in 8-bit fixed point.
    for i in 0..<width * height {
      let (r, g, b) = (UInt32(rgb[3 * i]), UInt32(rgb[3 * i + 1]), UInt32(rgb[3 * i + 2]))
      luma[i] = UInt8(truncatingIfNeeded: (77 &* r &+ 150 &* g &+ 29 &* b &+ 128) >> 8)
    }
  }

  /// The pixels, RGB; valid as long as this object lives.
  package var rgbBytes: UnsafeRawBufferPointer {
    UnsafeRawBufferPointer(start: rgb, count: 3 * width * height)
  }

  deinit {
    luma.deallocate()
    rgb.deallocate()
  }

  /// The C view, valid as long as this object lives.
  var raw: ck_patch_view {
    let r = cameraFromWorld.rotation.matrix.elements
    let t = cameraFromWorld.translation
    return ck_patch_view(
      width: Int32(width), height: Int32(height), luma: luma, fx: camera.focalLength.x,
      fy: camera.focalLength.y, cx: camera.principalPoint.x, cy: camera.principalPoint.y,
      rotation: (r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]),
      translation: (t.x, t.y, t.z))
  }
}
