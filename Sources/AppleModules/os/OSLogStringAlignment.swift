/// The column width and alignment of a value.
public struct OSLogStringAlignment: Hashable, Sendable {
  fileprivate let columns: Int
  fileprivate let isRight: Bool

  /// No padding.
  public static let none = OSLogStringAlignment(columns: 0, isRight: false)

  /// Left-aligned, padded to at least `columns` columns.
  public static func left(columns: @autoclosure () -> Int) -> OSLogStringAlignment {
    OSLogStringAlignment(columns: columns(), isRight: false)
  }

  /// Right-aligned, padded to at least `columns` columns.
  public static func right(columns: @autoclosure () -> Int) -> OSLogStringAlignment {
    OSLogStringAlignment(columns: columns(), isRight: true)
  }

  func aligned(_ text: String) -> String {
    let padding = String(repeating: " ", count: max(0, columns - text.count))
    return isRight ? padding + text : text + padding
  }
}
