import Foundation

extension JSONEncoder {
  /// An encoder of JSON for people: indented, with sorted keys and plain slashes.
  package static var readable: JSONEncoder {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys, .withoutEscapingSlashes]
    return encoder
  }
}
