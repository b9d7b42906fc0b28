/// A text with placeholders such as `{{TITLE}}`.
struct PageTemplate {
  enum Piece: Equatable {
    case text(String)
    case placeholder(String)
  }

  private(set) var pieces: [Piece] = []

  init(_ bytes: [UInt8]) {
    let text = String(decoding: bytes, as: UTF8.self)
    var rest = text[...]
    while let start = rest.firstRange(of: "{{"),
      let end = rest[start.upperBound...].firstRange(of: "}}")
    {
      pieces.append(.text(String(rest[..<start.lowerBound])))
      pieces.append(.placeholder(String(rest[start.upperBound..<end.lowerBound])))
      rest = rest[end.upperBound...]
    }
    pieces.append(.text(String(rest)))
  }
}
