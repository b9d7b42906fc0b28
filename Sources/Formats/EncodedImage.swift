import Foundation

/// The content of an image file.
package struct EncodedImage: Equatable, Sendable {
  /// `png`, `jpg` or `webp`.
  package var fileExtension: String
  /// The content of the file.
  package var bytes: [UInt8]

  package init(fileExtension: String, bytes: [UInt8]) {
    self.fileExtension = fileExtension
    self.bytes = bytes
  }

  var mediaType: String {
    switch fileExtension {
    case "png": "image/png"
    case "webp": "image/webp"
    default: "image/jpeg"
    }
  }

  /// The image as a data URL.
  package var dataURL: String {
    "data:\(mediaType);base64,\(Data(bytes).base64EncodedString())"
  }
}
