import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport

/// Files that must be rejected, or accepted despite the way they are stored.
struct BadPhotos {
  /// Two photos: one is kept intact, the other is damaged in various ways.
  var scene: RenderedScene

  func write(to folder: URL, _ control: KernelControl) throws {
    func save(_ bytes: [UInt8], _ name: String) throws {
      try writeFile(bytes, folder.appendingPathComponent(name))
    }
    let photo = try scene.photo(0, control)
    let other = try scene.photo(1, control)
    let jpeg = try ImageCodec.encodeJPEG(other, quality: 0.8)

    // Usable.
    try save(ImageCodec.encodeJPEG(photo, quality: 0.8), "original.jpg")
    try save(ImageCodec.encodePNG(other.resized(width: 360, height: 280)), "png-named.jpg")
    var exif = ExifFields()
    exif.orientation = 6
    let sideways = try ImageCodec.encodeJPEG(other.turned(byOrientation: 8), quality: 0.8)
    try save(ExifWriter.jpeg(sideways, with: exif), "orientation-6.jpg")

    // Not usable.
    try save(ImageCodec.encodeJPEG(photo, quality: 0.6), "recoded.jpg")
    try save(Array(jpeg.prefix(jpeg.count / 2)), "truncated.jpg")
    try save(corrupt(jpeg), "corrupt.jpg")
    try save([], "empty.jpg")
    try save(Array("Not a photo.\n".utf8), "text-named-as.jpg")
    try save(Array("focal length 552 pixels\n".utf8), "notes.txt")
    try save(ImageCodec.encodePNG(photo.resized(width: 64, height: 48)), "tiny.png")
    let soft = try photo.resized(width: 20, height: 15).resized(width: 480, height: 360)
    try save(ImageCodec.encodeJPEG(soft, quality: 0.95), "blurred.jpg")
    try save(
      ImageCodec.encodeJPEG(RasterImage(width: 480, height: 360, channels: 3), quality: 0.5),
      "black.jpg")
  }

  /// Overwrites a range in the middle of the pixel data.
  private func corrupt(_ jpeg: [UInt8]) -> [UInt8] {
    var bytes = jpeg
    var random = SeededGenerator(seed: 5)
    for index in bytes.count / 2..<bytes.count / 2 + 2000 {
      bytes[index] = UInt8(truncatingIfNeeded: random.next())
    }
    return bytes
  }
}
