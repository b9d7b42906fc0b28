import SceneModel

/// Builds a part from polygons whose corners have their own normals, texture coordinates and
/// colors: a vertex per position, split only where these differ.
struct PartBuilder {
  /// A corner of a polygon. All corners of a part have the same attributes.
  struct Corner: Equatable {
    /// Index into the positions.
    var position: Int
    var normal: SIMD3<Float>?
    var textureCoordinate: SIMD2<Float>?
    var color: SIMD3<UInt8>?
  }

  /// Vertices at one position that are compared with a corner before it gets a new one. Real models
  /// have a few; without a limit, hostile files would take quadratic time. Chosen.
  private static let maximumComparisons = 32
  private static let none = UInt32.max

  private(set) var part = LoadedModel.Part()
  private let positions: [SIMD3<Float>]
  /// For each position its latest vertex, and for each vertex the previous one at the same
  /// position.
  private var latest: [UInt32]
  private var previous: [UInt32] = []

  init(positions: [SIMD3<Float>]) {
    self.positions = positions
    latest = [UInt32](repeating: Self.none, count: positions.count)
  }

  /// Adds a polygon as a fan of triangles. Throws a `FormatFault` if a position doesn't exist.
  mutating func append(_ polygon: [Corner]) throws {
    guard polygon.count >= 3 else { return }
    let first = try vertex(polygon[0])
    var last = try vertex(polygon[1])
    for corner in polygon.dropFirst(2) {
      let next = try vertex(corner)
      part.triangles.append(Triangle(first, last, next))
      last = next
    }
  }

  private mutating func vertex(_ corner: Corner) throws -> UInt32 {
    guard positions.indices.contains(corner.position) else {
      throw FormatFault(
        "a face refers to vertex \(corner.position), but there are \(positions.count)")
    }
    var vertex = latest[corner.position]
    var comparisons = 0
    while vertex != Self.none, comparisons < Self.maximumComparisons {
      if matches(Int(vertex), corner) { return vertex }
      vertex = previous[Int(vertex)]
      comparisons += 1
    }
    return append(corner)
  }

  private func matches(_ vertex: Int, _ corner: Corner) -> Bool {
    if let st = corner.textureCoordinate, part.textureCoordinates[vertex] != st { return false }
    if let normal = corner.normal, part.normals[vertex] != normal { return false }
    if let color = corner.color, part.colors[vertex] != color { return false }
    return true
  }

  private mutating func append(_ corner: Corner) -> UInt32 {
    let vertex = UInt32(truncatingIfNeeded: part.positions.count)
    part.positions.append(positions[corner.position])
    if let normal = corner.normal { part.normals.append(normal) }
    if let st = corner.textureCoordinate { part.textureCoordinates.append(st) }
    if let color = corner.color { part.colors.append(color) }
    previous.append(latest[corner.position])
    latest[corner.position] = vertex
    return vertex
  }
}
