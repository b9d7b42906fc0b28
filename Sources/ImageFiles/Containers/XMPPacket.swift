/// The simple properties of an XMP packet (ISO 16684-1), by the names that their writer uses.
struct XMPPacket {
  private let text: String

  /// `bytes` are in UTF-8.
  init(_ bytes: [UInt8]) { text = String(decoding: bytes, as: UTF8.self) }

  /// The value of a property such as `apdi:FloatMinValue`, written as an element or an attribute.
  func text(_ name: String) -> String? { value(after: "<\(name)>") ?? value(after: "\(name)=\"") }

  /// The finite number in a property.
  func number(_ name: String) -> Float? {
    text(name).flatMap { Float($0) }.flatMap { $0.isFinite ? $0 : nil }
  }

  /// The text between a marker and the end of its element or attribute, without white space.
  private func value(after marker: String) -> String? {
    guard let start = text.firstRange(of: marker)?.upperBound else { return nil }
    let value = text[start...].prefix { $0 != "<" && $0 != "\"" }.split { $0.isWhitespace }
    return value.count == 1 ? String(value[0]) : nil
  }
}
