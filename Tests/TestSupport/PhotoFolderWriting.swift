import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestFiles

extension TemporaryFolder {
  /// Writes the JPEG files `photos/p0.jpg`, `photos/p1.jpg` and so on, without metadata.
  package func writePhotos(_ photos: [RasterImage]) throws {
    for (index, photo) in photos.enumerated() {
      try write(ImageCodec.encodeJPEG(photo, quality: 0.95), as: "photos/p\(index).jpg")
    }
  }

  /// Writes photos as JPEG files named like rendered photos, starting at number `first`. A focal
  /// length in pixels is stored in their EXIF data.
  package func write(
    _ photos: [RasterImage], focalLength: Double?, first: Int = 0, prefix: String = ""
  ) throws {
    for (index, photo) in photos.enumerated() {
      var bytes = try ImageCodec.encodeJPEG(photo, quality: 0.9)
      if let focalLength {
        var exif = ExifFields()
        exif.make = "Rendered"
        exif.model = "Pinhole"
        let millimeters = 36 * focalLength / Double(max(photo.width, photo.height))
        exif.focalLength = (UInt32((millimeters * 1000).rounded()), 1000)
        exif.focalLengthIn35mmFilm = Int(millimeters.rounded())
        bytes = ExifWriter.jpeg(bytes, with: exif)
      }
      try Data(bytes).write(
        to: url.appendingPathComponent(prefix + RenderedScene.name(first + index)))
    }
  }
}
