/// The values of one kind of a mesh's vertices or triangles.
public struct MeshBuffer<Element: Sendable>: RandomAccessCollection, Sendable {
  /// The values.
  public let elements: [Element]

  /// Creates a buffer from its values.
  public init(_ elements: [Element]) { self.elements = elements }

  /// The place of the first value.
  public var startIndex: Int { elements.startIndex }
  /// The place after the last value.
  public var endIndex: Int { elements.endIndex }

  /// The value at a place.
  public subscript(position: Int) -> Element { elements[position] }
}

/// Named elements of a mesh.
public struct MeshElements<Element: Identifiable & Sendable>: RandomAccessCollection, Sendable
where Element.ID == String {
  private let elements: [Element]

  /// Creates a collection from its elements.
  public init(_ elements: [Element]) { self.elements = elements }

  /// The place of the first element.
  public var startIndex: Int { elements.startIndex }
  /// The place after the last element.
  public var endIndex: Int { elements.endIndex }

  /// The element at a place.
  public subscript(position: Int) -> Element { elements[position] }

  /// The element of a name; nil where there is none.
  public subscript(id: String) -> Element? { elements.first { $0.id == id } }
}
