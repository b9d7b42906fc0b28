import SceneModel

/// A short list for each vertex of a mesh, all in one array: sets are slow for millions of edges.
struct VertexLists<Value: Equatable & Sendable>: Sendable {
  private var offsets: [Int32]
  private var ends: [Int32]
  private var values: [Value]

  /// `capacities` bounds the length of each vertex's list.
  init(capacities: [Int32], empty: Value) {
    var sum: Int32 = 0
    offsets = capacities.map { capacity in
      defer { sum += capacity }
      return sum
    }
    ends = offsets
    values = Array(repeating: empty, count: Int(sum))
  }

  /// Appends a value to the list of a vertex, within its capacity.
  mutating func append(_ value: Value, at vertex: UInt32) {
    values[Int(ends[Int(vertex)])] = value
    ends[Int(vertex)] += 1
  }

  subscript(vertex: UInt32) -> ArraySlice<Value> {
    values[Int(offsets[Int(vertex)])..<Int(ends[Int(vertex)])]
  }

  func contains(_ value: Value, at vertex: UInt32) -> Bool { self[vertex].contains(value) }
}
