extension EncodedImage {
  /// An image whose format is recognized by its first bytes; nil unless it is one of the formats of
  /// `fileExtension`.
  init?(recognizing bytes: [UInt8]) {
    func has(_ text: String, at offset: Int) -> Bool {
      bytes.dropFirst(offset).starts(with: text.utf8)
    }
    if bytes.starts(with: [0x89] + Array("PNG\r\n".utf8)) {
      self.init(fileExtension: "png", bytes: bytes)
    } else if bytes.starts(with: [0xFF, 0xD8, 0xFF]) {
      self.init(fileExtension: "jpg", bytes: bytes)
    } else if has("RIFF", at: 0), has("WEBP", at: 8) {
      self.init(fileExtension: "webp", bytes: bytes)
    } else {
      return nil
    }
  }
}
