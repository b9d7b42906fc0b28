/// The content of an image file.
package struct EncodedImage: Equatable, Sendable {
  /// `png` or `jpg`.
  package var fileExtension: String
  /// The content of the file.
  package var bytes: [UInt8]

  package init(fileExtension: String, bytes: [UInt8]) {
    self.fileExtension = fileExtension
    self.bytes = bytes
  }

  var mediaType: String { fileExtension == "png" ? "image/png" : "image/jpeg" }
}
