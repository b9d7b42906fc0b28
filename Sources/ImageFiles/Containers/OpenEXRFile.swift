import CKernels
import Kernels
import SceneModel

/// Headers of OpenEXR files.
enum OpenEXRFile {
  /// Whether a file starts as an OpenEXR file does.
  static func isOpenEXR(_ reader: ByteReader) -> Bool {
    reader.hasPrefix([0x76, 0x2F, 0x31, 0x01])
  }

  /// The size of a file's only image, and whether it has an alpha channel.
  static func inspect(
    _ bytes: [UInt8]
  ) throws(ImageError) -> (width: Int, height: Int, hasAlpha: Bool) {
    var info = ck_exr_info()
    do {
      try withKernel(KernelControl()) { _ in ck_exr_inspect(bytes, bytes.count, &info) }
    } catch {
      if let specific = ImageHeader.Format.openEXR.error(for: error) { throw specific }
      throw .damaged("its OpenEXR header is damaged or cut off")
    }
    guard info.parts == 1 else {
      throw .unsupportedFormat("an OpenEXR file with \(info.parts) images")
    }
    guard !info.is_deep else {
      throw .unsupportedFormat("a deep OpenEXR image, with several samples per pixel")
    }
    return (Int(info.width), Int(info.height), info.has_alpha)
  }
}
