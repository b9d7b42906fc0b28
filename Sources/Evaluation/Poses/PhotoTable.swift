import Foundation

/// Values by the names of photos, which programs write differently: with or without the folder and
/// the extension.
package struct PhotoTable<Value> {
  private var exact: [String: Value] = [:]
  /// Nil where several names have the stem.
  private var stems: [String: Value?] = [:]

  /// The first of several values with the same name counts.
  package init(_ entries: [(name: String, value: Value)]) {
    for (name, value) in entries where exact[name] == nil {
      exact[name] = value
      let stem = Self.stem(name)
      stems.updateValue(stems[stem] == nil ? value : Value?.none, forKey: stem)
    }
  }

  /// The value of the photo of that name, or of the only one whose name differs in folder,
  /// extension and case only.
  package subscript(name: String) -> Value? {
    exact[name] ?? stems[Self.stem(name)].flatMap { $0 }
  }

  private static func stem(_ name: String) -> String {
    let file = (name as NSString).lastPathComponent as NSString
    return file.deletingPathExtension.lowercased()
  }
}
