import Foundation

/// An `os_log` format string: that of `printf` with options in braces, such as `%{public}@`.
struct LogFormat {
  private var pieces: [(format: String, isHidden: Bool)] = []
  private var tail = ""

  init(_ format: String) {
    var rest = Substring(format)
    var literal = ""
    while let percent = rest.firstIndex(of: "%") {
      literal += rest[..<percent]
      rest = rest[rest.index(after: percent)...]
      guard let next = rest.first else { break }
      if next == "%" {
        literal += "%%"
        rest = rest.dropFirst()
        continue
      }
      var options = ""
      if next == "{", let end = rest.firstIndex(of: "}") {
        options = String(rest[rest.index(after: rest.startIndex)..<end])
        rest = rest[rest.index(after: end)...]
      }
      let specifier = rest.prefix { !($0.isLetter || $0 == "@") || "hlqLtzj".contains($0) }
      rest = rest.dropFirst(specifier.count)
      guard let conversion = rest.popFirst() else { break }
      let names = options.split(separator: ",").map { $0.trimmingCharacters(in: .whitespaces) }
      pieces.append(
        (
          "\(literal)%\(specifier)\(conversion)",
          names.contains("private") || names.contains("sensitive")
        ))
      literal = ""
    }
    tail = literal + rest
  }

  /// The formatted text; specifiers without a value are kept as written.
  func text(_ values: [any CVarArg]) -> String {
    var text = ""
    for (index, piece) in pieces.enumerated() {
      guard values.indices.contains(index) else {
        text += Self.unescaped(piece.format)
        continue
      }
      if piece.isHidden {
        let literal = piece.format[..<(piece.format.lastIndex(of: "%") ?? piece.format.endIndex)]
        text += Self.unescaped(literal) + "<private>"
      } else {
        text += String(format: piece.format, arguments: [values[index]])
      }
    }
    return text + Self.unescaped(tail)
  }

  private static func unescaped(_ text: some StringProtocol) -> String {
    text.replacingOccurrences(of: "%%", with: "%")
  }
}
