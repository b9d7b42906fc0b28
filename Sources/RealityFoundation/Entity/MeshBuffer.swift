/// The values of one vertex or triangle attribute of a mesh.
public struct MeshBuffer<Element: Sendable>: RandomAccessCollection, Sendable {
  /// The values.
  public let elements: [Element]

  /// Creates a buffer from its values.
  public init(_ elements: [Element]) { self.elements = elements }

  /// The index of the first value.
  public var startIndex: Int { elements.startIndex }
  /// The index after the last value.
  public var endIndex: Int { elements.endIndex }

  /// The value at an index.
  public subscript(position: Int) -> Element { elements[position] }
}
