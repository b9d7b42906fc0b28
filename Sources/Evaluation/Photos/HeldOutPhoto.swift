import Foundation
import ImageFiles
import Kernels
import SceneModel

/// A photo that was not among the input, with its camera: what a model should look like there.
package struct HeldOutPhoto: Sendable {
  /// In the frame of the reference.
  package var camera: NamedCamera
  package var file: URL
  /// White where the object is; nil if all pixels count.
  package var mask: URL?

  /// The photos in `folder` that `cameras` has a camera for, in its order. The mask of `a.jpg` is
  /// `a_mask.png` beside it.
  package static func photos(in folder: URL, _ cameras: [NamedCamera]) -> [HeldOutPhoto] {
    let names = (try? FileManager.default.contentsOfDirectory(atPath: folder.path)) ?? []
    let files = names.sorted().filter { !$0.contains("_mask.") }
    let table = PhotoTable(files.map { ($0, $0) })
    return cameras.compactMap { camera in
      guard let name = table[camera.name] else { return nil }
      let mask = folder.appendingPathComponent(maskName(of: name))
      return HeldOutPhoto(
        camera: camera, file: folder.appendingPathComponent(name),
        mask: FileManager.default.fileExists(atPath: mask.path) ? mask : nil)
    }
  }

  private static func maskName(of photo: String) -> String {
    "\((photo as NSString).deletingPathExtension)_mask.png"
  }

  /// The pixels as stored, or upright if only then they have the shape of the camera's photo.
  /// Throws an `ImageError`.
  func image() throws -> RasterImage {
    let bytes = try ImageCodec.contents(of: file)
    let image = try ImageCodec.decode(bytes)
    guard camera.isSizeKnown, !Self.fits(camera.camera, image) else { return image }
    let orientation = PhotoMetadata(bytes).orientation
    let upright = try image.turned(byOrientation: orientation)
    return Self.fits(camera.camera, upright) ? upright : image
  }

  /// The gray mask of an image's size.
  func mask(for image: RasterImage) throws -> RasterImage? {
    guard let mask else { return nil }
    let decoded = try ImageCodec.decode(try ImageCodec.contents(of: mask)).gray
    return try decoded.resized(width: image.width, height: image.height)
  }

  private static func fits(_ camera: Camera, _ image: RasterImage) -> Bool {
    camera.width * image.height == camera.height * image.width
  }
}
