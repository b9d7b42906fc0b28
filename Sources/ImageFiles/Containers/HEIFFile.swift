import CKernels
import Kernels
import SceneModel

/// Metadata of HEIF files (ISO/IEC 23008-12), read by libheif.
package enum HEIFFile {
  /// The content of a file according to its brands.
  package enum Kind: Hashable, Sendable {
    /// A photo, or several with a primary one.
    case image(ImageHeader.Format)
    /// A burst or a short video without a primary image.
    case sequence

    /// Nil for other files, including videos.
    package init?(_ reader: ByteReader) {
      guard reader.hasText("ftyp", at: 4), let size = reader.uint32(0, .big), size >= 16 else {
        return nil
      }
      // The major brand, its version, and the compatible brands.
      let places = [8] + Array(stride(from: 16, to: min(size, 256), by: 4))
      let brands = Set(places.compactMap { reader.text(at: $0, count: 4) })
      if brands.contains("avif") {
        self = .image(.avif)
      } else if !brands.isDisjoint(with: ["heic", "heix", "heim", "heis", "mif1"]) {
        self = .image(.heic)
      } else if !brands.isDisjoint(with: ["hevc", "hevx", "hevm", "hevs", "msf1", "avis"]) {
        self = .sequence
      } else {
        return nil
      }
    }
  }

  /// Size in pixels of the primary image, upright, and whether it has an alpha channel.
  static func inspect(
    _ bytes: [UInt8], _ format: ImageHeader.Format
  ) throws(ImageError) -> (width: Int, height: Int, hasAlpha: Bool) {
    var info = ck_heif_info()
    do {
      try withKernel(KernelControl()) { _ in ck_heif_inspect(bytes, bytes.count, &info) }
    } catch {
      if let specific = format.error(for: error) { throw specific }
      throw .damaged("its \(format.rawValue) header is damaged or cut off")
    }
    return (Int(info.width), Int(info.height), info.has_alpha)
  }

  /// The EXIF data of a file, starting at its TIFF header; nil without any.
  package static func exif(_ bytes: [UInt8]) -> [UInt8]? { block(ck_heif_exif, of: bytes) }

  /// The ICC profile of a file; nil without one.
  static func colorProfile(_ bytes: [UInt8]) -> [UInt8]? {
    block(ck_heif_color_profile, of: bytes)
  }

  /// One metadata block of a file; nil without one or if it can't be read.
  private static func block(_ which: ck_heif_block, of bytes: [UInt8]) -> [UInt8]? {
    var block: OpaquePointer?
    try? withKernel(KernelControl()) { _ in ck_heif_read(bytes, bytes.count, which, &block) }
    let content = [UInt8](taking: block)
    return content.isEmpty ? nil : content
  }
}
