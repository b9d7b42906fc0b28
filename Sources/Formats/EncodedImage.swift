/// An image as the content of a file.
package struct EncodedImage: Equatable, Sendable {
  /// `png` or `jpg`.
  package var fileExtension: String
  package var bytes: [UInt8]

  package init(fileExtension: String, bytes: [UInt8]) {
    self.fileExtension = fileExtension
    self.bytes = bytes
  }

  var mediaType: String { fileExtension == "png" ? "image/png" : "image/jpeg" }
}
