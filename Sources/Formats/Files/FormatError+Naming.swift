import Foundation

extension FormatError {
  /// Calls `body`, and adds the path of the file to its faults. Throws a `FormatError`, or what
  /// else `body` throws.
  static func naming<Value>(_ url: URL, _ body: () throws -> Value) throws -> Value {
    do {
      return try body()
    } catch let fault as FormatFault {
      throw malformed(path: url.path, reason: fault.reason)
    } catch is ByteCursor.Truncated {
      throw malformed(path: url.path, reason: "it ends too early, or a size is wrong")
    } catch let feature as UnsupportedFeature {
      throw unsupported(path: url.path, reason: feature.reason, remedy: feature.remedy)
    }
  }
}
