import Foundation
import SceneModel

extension PLY {
  /// Writes a mesh, with normals and colors if it has them; throws `OutputError`. Pairs of
  /// consecutive triangles in the ranges `halves` are written as quads.
  package static func write(_ mesh: Mesh, halves: [Range<Int>] = [], to url: URL) throws {
    try AtomicFile.write(encode(mesh, halves: halves), to: url)
  }

  /// The bytes that `write` writes.
  package static func encode(_ mesh: Mesh, halves: [Range<Int>] = []) -> [UInt8] {
    let quadCount = halves.map(\.count).reduce(0, +) / 2
    let count = mesh.positions.count
    let hasNormals = mesh.normals.count == count && count > 0
    let hasColors = mesh.colors.count == count && count > 0
    var header = headerStart(vertices: count, normals: hasNormals, colors: hasColors)
    header += "element face \(mesh.triangles.count - quadCount)\n"
    header += "property list uchar int vertex_indices\nend_header\n"
    var writer = ByteWriter(
      capacity: header.utf8.count + count * 27 + mesh.triangles.count * 13)
    writer.append(header)
    for index in 0..<count {
      writer.append(mesh.positions[index])
      if hasNormals { writer.append(mesh.normals[index]) }
      if hasColors { writer.append(mesh.colors[index]) }
    }
    var next = 0
    for range in halves {
      append(mesh.triangles[next..<range.lowerBound], to: &writer)
      for half in stride(from: range.lowerBound, to: range.upperBound, by: 2) {
        writer.append(UInt8(4))
        let corners = mesh.triangles[half].quad(with: mesh.triangles[half + 1])
        corners.forEach { writer.append($0) }
      }
      next = range.upperBound
    }
    append(mesh.triangles[next...], to: &writer)
    return writer.bytes
  }

  private static func append(_ triangles: ArraySlice<Triangle>, to writer: inout ByteWriter) {
    for triangle in triangles {
      writer.append(UInt8(3))
      writer.append(triangle.a)
      writer.append(triangle.b)
      writer.append(triangle.c)
    }
  }

  /// Reads a mesh; faces with more than three corners become triangle fans. Throws `FormatError`.
  package static func readMesh(_ url: URL) throws -> Mesh {
    try read(url) { reader in
      guard let vertex = reader.header.elements.first(where: { $0.name == "vertex" }),
        let position = triple(vertex, "x", "y", "z")
      else { throw FormatFault("it has no vertices with x, y and z") }
      let normal = triple(vertex, "nx", "ny", "nz")
      let color = triple(vertex, "red", "green", "blue")
      var mesh = Mesh()
      try reader.forEachRow { element, row in
        if element.name == "vertex" {
          let point = vector(row, position)
          guard point.isFinite else { throw FormatFault("a vertex is not finite") }
          mesh.positions.append(point)
          if let normal { mesh.normals.append(vector(row, normal)) }
          if let color { mesh.colors.append(Self.color(row, color, in: element)) }
        } else if element.name == "face",
          let corners = element.listIndex(of: "vertex_indices", "vertex_index")
        {
          try appendFan(row.lists[corners], vertices: vertex.count, to: &mesh)
        }
      }
      return mesh
    }
  }

  private static func appendFan(
    _ corners: [Double], vertices: Int, to mesh: inout Mesh
  ) throws {
    let indices = try corners.map { corner in
      guard let index = UInt32(exactly: corner), index < vertices else {
        throw FormatFault("a face refers to vertex \(corner) of \(vertices)")
      }
      return index
    }
    guard indices.count >= 3 else { return }
    for corner in 1..<(indices.count - 1) {
      mesh.triangles.append(Triangle(indices[0], indices[corner], indices[corner + 1]))
    }
  }
}
