import CKernels
import Kernels
import SceneModel

/// Camera raw files, read by LibRaw.
package enum CameraRawFile {
  /// Starts of files that aren't TIFF files: their offsets, and the text there.
  private static let signatures: [(offset: Int, text: String)] = [
    (4, "ftypcrx "),  // Canon CR3
    (6, "HEAPCCDR"),  // Canon CRW
    (0, "FUJIFILMCCD-RAW"), (0, "IIRO"), (0, "IIRS"), (0, "MMOR"),  // Fujifilm, Olympus
    (0, "IIU\0"), (0, "IIII"), (0, "FOVb"), (0, "\0MRM"),  // Panasonic, Phase One, Sigma, Minolta
  ]
  /// Photometric interpretations of raw pixels: color filter array, linear raw (DNG 1.4).
  private static let rawInterpretations = [32803, 34892]

  /// Whether a file's content is that of a raw file. Most are TIFF files with further tags, whose
  /// first image is a preview.
  package static func isRaw(_ bytes: [UInt8]) -> Bool { isRaw(ByteReader(bytes)) }

  static func isRaw(_ reader: ByteReader) -> Bool {
    if signatures.contains(where: { reader.hasText($0.text, at: $0.offset) }) { return true }
    guard let tiff = TIFFStructure(reader) else { return false }
    // Canon's CR2 has raw pixels in its fourth directory.
    if reader.hasText("CR", at: 8) { return true }
    let main = tiff.firstDirectory
    let isThumbnail = (tiff.integer(of: TIFFTag.subfileType, in: main) ?? 0) & 1 != 0
    return isThumbnail || tiff.integer(of: TIFFTag.dngVersion, in: main) != nil
      || ([main] + subdirectories(tiff)).contains { directory in
        tiff.integer(of: TIFFTag.photometricInterpretation, in: directory)
          .map(rawInterpretations.contains) ?? false
      }
  }

  private static func subdirectories(_ tiff: TIFFStructure) -> [Int] {
    let entries = tiff.entries(ofDirectoryAt: tiff.firstDirectory)
    guard let entry = entries.first(where: { $0.tag == TIFFTag.subdirectories }) else { return [] }
    return (0..<min(entry.count, 8)).compactMap { tiff.integer(entry, $0) }
  }

  /// The properties of a file.
  static func inspect(_ bytes: [UInt8]) throws(ImageError) -> ck_raw_info {
    var info = ck_raw_info()
    do {
      try withKernel(KernelControl()) { _ in ck_raw_inspect(bytes, bytes.count, &info) }
    } catch {
      if let specific = ImageHeader.Format.cameraRaw.error(for: error) { throw specific }
      throw .damaged("its camera raw header is damaged or cut off")
    }
    return info
  }
}
