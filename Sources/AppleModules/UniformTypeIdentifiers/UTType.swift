import Foundation

/// A kind of data, such as JPEG, which is an image, which is data.
///
/// Kinds of images, models, videos and folders are known here; a suffix or name of any other kind
/// gives none.
public struct UTType: Hashable, Codable, Sendable {
  /// The name of the kind, in reverse domain notation.
  public let identifier: String

  /// Creates a kind from its name; fails where it isn't known.
  public init?(_ identifier: String) {
    guard Self.known.contains(where: { $0.identifier == identifier }) else { return nil }
    self.identifier = identifier
  }

  /// Creates a kind from a file's suffix; fails where it isn't known or not of the other kind.
  public init?(filenameExtension: String, conformingTo supertype: UTType = .data) {
    let suffix = filenameExtension.lowercased()
    guard let entry = Self.known.first(where: { $0.suffixes.contains(suffix) }) else { return nil }
    identifier = entry.identifier
    guard conforms(to: supertype) else { return nil }
  }

  /// Creates a kind from its name on the net; fails where it isn't known or not of the other kind.
  public init?(mimeType: String, conformingTo supertype: UTType = .data) {
    let name = mimeType.lowercased()
    guard let entry = Self.known.first(where: { $0.mimeType == name }) else { return nil }
    identifier = entry.identifier
    guard conforms(to: supertype) else { return nil }
  }

  init(known identifier: String) { self.identifier = identifier }

  private var entry: UniformType? { Self.known.first { $0.identifier == identifier } }

  /// The suffix that files of the kind should have.
  public var preferredFilenameExtension: String? { entry?.suffixes.first }

  /// The name of the kind on the net.
  public var preferredMIMEType: String? { entry?.mimeType }

  /// The kinds that this is one of, itself left out.
  public var supertypes: Set<UTType> {
    let parents = entry?.parents.map { UTType(known: $0) } ?? []
    return parents.reduce(into: Set(parents)) { $0.formUnion($1.supertypes) }
  }

  /// Whether this is the other kind, or one of it.
  public func conforms(to type: UTType) -> Bool { self == type || supertypes.contains(type) }

  /// Whether this is one of the other kind, and another.
  public func isSubtype(of type: UTType) -> Bool { supertypes.contains(type) }

  /// Whether the other is one of this kind, and another.
  public func isSupertype(of type: UTType) -> Bool { type.supertypes.contains(self) }
}

extension UTType: CustomStringConvertible {
  /// The name of the kind.
  public var description: String { identifier }
}

extension URL {
  /// This place with a name at the end, and the suffix of a kind where the name has none.
  public func appendingPathComponent(_ partialName: String, conformingTo type: UTType) -> URL {
    let url = appendingPathComponent(partialName, isDirectory: type.conforms(to: .directory))
    return url.pathExtension.isEmpty ? url.appendingPathExtension(for: type) : url
  }

  /// This place with the suffix of a kind at the end.
  public func appendingPathExtension(for type: UTType) -> URL {
    type.preferredFilenameExtension.map { appendingPathExtension($0) } ?? self
  }
}
