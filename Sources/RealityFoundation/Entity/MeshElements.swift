/// Named elements of a mesh.
public struct MeshElements<Element: Identifiable & Sendable>: RandomAccessCollection, Sendable
where Element.ID == String {
  private let elements: [Element]

  /// Creates a collection from its elements.
  public init(_ elements: [Element]) { self.elements = elements }

  /// The index of the first element.
  public var startIndex: Int { elements.startIndex }
  /// The index after the last element.
  public var endIndex: Int { elements.endIndex }

  /// The element at an index.
  public subscript(position: Int) -> Element { elements[position] }

  /// The element with a name; nil if there is none.
  public subscript(id: String) -> Element? { elements.first { $0.id == id } }
}
