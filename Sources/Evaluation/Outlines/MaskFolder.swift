import Foundation
import ImageFiles
import Kernels
import SceneModel

/// A folder with a mask per photo, white or opaque where the object is.
package struct MaskFolder: Sendable {
  private let files: [String: URL]

  /// Masks are named like their photos, with or without a suffix `mask` and leading zeros:
  /// `IMG_1_mask.png` for `IMG_1.jpg`, `012.png` for `000012.png`.
  package init(_ folder: URL) {
    let names = (try? FileManager.default.contentsOfDirectory(atPath: folder.path)) ?? []
    let images = names.sorted().filter {
      ["png", "jpg", "jpeg", "tif", "tiff", "webp"].contains(
        ($0 as NSString).pathExtension.lowercased())
    }
    files = Dictionary(
      images.map { (Self.key($0), folder.appendingPathComponent($0)) }
    ) { first, _ in first }
  }

  package var isEmpty: Bool { files.isEmpty }

  /// The names of the masks' files.
  package var names: [String] { files.values.map(\.lastPathComponent).sorted() }

  /// The mask of a photo: 1 per pixel where the object is, at the given size; turned upright if the
  /// stored pixels have the other format. Nil without one; throws an `ImageError`.
  package func mask(of photo: String, width: Int, height: Int) throws -> [Bool]? {
    guard let file = files[Self.key(photo)] else { return nil }
    let bytes = try ImageCodec.contents(of: file)
    var image = try ImageCodec.decodeAlpha(bytes) ?? ImageCodec.decode(bytes).gray
    if (image.width > image.height) != (width > height) {
      image = try image.turned(byOrientation: PhotoMetadata(bytes).orientation)
    }
    return try image.resized(width: width, height: height).pixels.map { $0 > 127 }
  }

  /// The size of a mask's image; nil without one.
  func size(of photo: String) throws -> (width: Int, height: Int)? {
    guard let file = files[Self.key(photo)] else { return nil }
    let image = try ImageCodec.decode(try ImageCodec.contents(of: file))
    return (image.width, image.height)
  }

  private static func key(_ name: String) -> String {
    var stem = ((name as NSString).lastPathComponent as NSString).deletingPathExtension
    if stem.lowercased().hasSuffix("mask") {
      stem.removeLast(4)
      if let last = stem.last, "-_".contains(last) { stem.removeLast() }
    }
    let digits = stem.drop { $0 == "0" }
    return digits.isEmpty ? "0" : String(digits)
  }
}
