import Foundation

/// A uniform type of data, such as JPEG, which conforms to image, which conforms to data.
///
/// Types of images, models, videos, text and folders are known; other extensions and identifiers
/// give nil.
public struct UTType: Hashable, Codable, Sendable {
  /// The identifier in reverse-DNS notation.
  public let identifier: String

  /// Creates a type from its identifier; nil if it isn't known.
  public init?(_ identifier: String) {
    guard UniformType.known.contains(where: { $0.identifier == identifier }) else { return nil }
    self.identifier = identifier
  }

  /// Creates a type from a file extension; nil if it isn't known or doesn't conform to `supertype`.
  public init?(filenameExtension: String, conformingTo supertype: UTType = .data) {
    let suffix = filenameExtension.lowercased()
    guard
      let entry = UniformType.known.first(where: { $0.filenameExtensions.contains(suffix) })
    else { return nil }
    identifier = entry.identifier
    guard conforms(to: supertype) else { return nil }
  }

  /// Creates a type from a MIME type; nil if it isn't known or doesn't conform to `supertype`.
  public init?(mimeType: String, conformingTo supertype: UTType = .data) {
    let name = mimeType.lowercased()
    guard let entry = UniformType.known.first(where: { $0.mimeType == name }) else { return nil }
    identifier = entry.identifier
    guard conforms(to: supertype) else { return nil }
  }

  init(known identifier: String) { self.identifier = identifier }

  private var entry: UniformType? { UniformType.known.first { $0.identifier == identifier } }

  /// The preferred file extension.
  public var preferredFilenameExtension: String? { entry?.filenameExtensions.first }

  /// The preferred MIME type.
  public var preferredMIMEType: String? { entry?.mimeType }

  /// All types that this type conforms to, except itself.
  public var supertypes: Set<UTType> {
    let parents = entry?.parents.map { UTType(known: $0) } ?? []
    return parents.reduce(into: Set(parents)) { $0.formUnion($1.supertypes) }
  }

  /// Whether this type equals the other one or conforms to it.
  public func conforms(to type: UTType) -> Bool { self == type || supertypes.contains(type) }

  /// Whether this type conforms to the other one and differs from it.
  public func isSubtype(of type: UTType) -> Bool { supertypes.contains(type) }

  /// Whether the other type conforms to this one and differs from it.
  public func isSupertype(of type: UTType) -> Bool { type.supertypes.contains(self) }
}

extension UTType: CustomStringConvertible {
  /// The identifier.
  public var description: String { identifier }
}

extension URL {
  /// Appends a path component, with the type's preferred extension if the name has none.
  public func appendingPathComponent(_ partialName: String, conformingTo type: UTType) -> URL {
    let url = appendingPathComponent(partialName, isDirectory: type.conforms(to: .directory))
    return url.pathExtension.isEmpty ? url.appendingPathExtension(for: type) : url
  }

  /// Appends the type's preferred extension.
  public func appendingPathExtension(for type: UTType) -> URL {
    type.preferredFilenameExtension.map { appendingPathExtension($0) } ?? self
  }
}
