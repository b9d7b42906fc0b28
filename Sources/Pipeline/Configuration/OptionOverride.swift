import Foundation

/// Another value for one option of a configuration, for measurements.
///
/// Written `alignment.correspondences.matching.ratio=0.8`: the path of the option in the
/// configuration of `report.json`, and a number, `true`, `false`, or one of the option's words.
package struct OptionOverride: Hashable, Sendable {
  package let path: [String]
  package let value: String

  /// Nil unless `text` is a path and a value.
  package init?(_ text: String) {
    let parts = text.split(separator: "=", maxSplits: 1, omittingEmptySubsequences: false)
    guard parts.count == 2, !parts[1].isEmpty else { return nil }
    path = parts[0].split(separator: ".", omittingEmptySubsequences: false).map(String.init)
    guard !path.contains("") else { return nil }
    value = String(parts[1])
  }
}

extension PipelineConfiguration {
  /// The configuration with some options changed. Throws an `OptionOverrideError`.
  package func applying(_ overrides: [OptionOverride]) throws -> PipelineConfiguration {
    guard !overrides.isEmpty else { return self }
    var encoded = try JSONValue(encoding: self)
    for change in overrides { try encoded.apply(change, at: change.path[...]) }
    do {
      let data = try JSONEncoder().encode(encoded)
      return try JSONDecoder().decode(PipelineConfiguration.self, from: data)
    } catch {
      let last = overrides[overrides.count - 1]
      throw OptionOverrideError.wrongValue(
        path: last.path.joined(separator: "."), value: last.value)
    }
  }
}

extension JSONValue {
  fileprivate mutating func apply(_ change: OptionOverride, at rest: ArraySlice<String>) throws {
    let path = change.path.joined(separator: ".")
    guard let key = rest.first else {
      self = try replacement(change.value, path)
      return
    }
    guard case .object(var members) = self, var member = members[key] else {
      var choices: [String] = []
      if case .object(let members) = self { choices = members.keys.sorted() }
      throw OptionOverrideError.unknownOption(path: path, choices: choices)
    }
    try member.apply(change, at: rest.dropFirst())
    members[key] = member
    self = .object(members)
  }

  /// A value of the same kind.
  private func replacement(_ text: String, _ path: String) throws -> JSONValue {
    switch self {
    case .number:
      if let number = Double(text), number.isFinite { return .number(number) }
    case .bool:
      if let flag = Bool(text) { return .bool(flag) }
    case .string: return .string(text)
    case .object(let members):
      throw OptionOverrideError.unknownOption(path: path, choices: members.keys.sorted())
    case .array, .null: break
    }
    throw OptionOverrideError.wrongValue(path: path, value: text)
  }
}
