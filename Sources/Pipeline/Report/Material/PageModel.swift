import Formats
import Foundation
import Kernels
import SceneModel

/// A model as the page draws it: small numbers, and one color texture of a part.
package struct PageModel: Encodable, Sendable {
  /// The position is `origin` + `size` · coordinates / 65535.
  package var origin: SIMD3<Float>
  package var size: Float
  /// 16 bits each, little-endian, as are coordinates.
  package var positions: Data
  /// Signed bytes, 127 for 1.
  package var normals: Data
  /// Texture coordinates are `coordinateOrigin` + `coordinateSize` · these / 65535, with the origin
  /// at the bottom left; empty without textures.
  package var coordinates = Data()
  package var coordinateOrigin = SIMD2<Float>(0, 0)
  package var coordinateSize = SIMD2<Float>(1, 1)
  /// RGB; empty with textures.
  package var colors = Data()
  /// Indices of 16 bits, or of 32 with more vertices.
  package var triangles: Data
  package var parts: [Part]
  package var maps: [Map]

  /// Consecutive triangles with one texture.
  package struct Part: Encodable, Sendable {
    package var first: Int
    package var count: Int
    /// A data URL.
    package var texture: String?
  }

  /// A heat map, one byte per vertex: 0…254 for `low`…`high`, 255 where there is no value.
  package struct Map: Encodable, Sendable {
    package var key: VertexFigures.Kind
    package var name: String
    package var unit: String
    package var low: Float = 0
    package var high: Float
    package var values: Data
  }

  package struct Options: Hashable, Sendable {
    /// A model with more triangles is simplified, and has a color per vertex. Measured: one picture
    /// a second with software rendering on two cores.
    package var maximumTriangles = 250_000
    /// Maximum side of a texture, and of all together. Chosen: 0.4 MB.
    package var textureSide = 2048
    /// Chosen: by eye.
    package var quality: Float = 0.8

    package init() {}
  }

  package var triangleCount: Int { parts.reduce(0) { $0 + $1.count } }

  /// `figures` have a value for each vertex of `model`.
  init(
    _ model: TexturedMesh, _ figures: [VertexFigures], options: Options = Options(),
    _ context: StageContext
  ) throws {
    let isTextured =
      model.textureTriangles.count == model.mesh.triangles.count
      && model.atlases.contains { $0.maps[.diffuseColor] != nil }
    if model.mesh.triangles.count > options.maximumTriangles || !isTextured {
      try self.init(colored: model, figures, options, context)
    } else {
      try self.init(textured: model, figures, options)
    }
  }

  /// A model with textures: vertices are split where charts meet.
  private init(
    textured model: TexturedMesh, _ figures: [VertexFigures], _ options: Options
  ) throws {
    let corners = CornerVertices(model)
    let mesh = model.mesh
    self.init(
      corners.vertices.map { mesh.positions[Int($0.position)] },
      normals: corners.vertices.map { mesh.normals[Int($0.position)] },
      triangles: corners.triangles)
    set(coordinates: corners.vertices.map { model.textureCoordinates[Int($0.coordinate)] })
    let side = Int(
      Double(options.textureSide) / Double(max(1, model.atlases.count)).squareRoot())
    parts = try model.atlases.map { atlas in
      Part(
        first: atlas.triangles.lowerBound, count: atlas.triangles.count,
        texture: try atlas.maps[.diffuseColor].map { image in
          try image.fitted(to: side).dataURL(quality: options.quality)
        })
    }
    maps = figures.map { figure in
      let bytes = figure.bytes
      return Map(figure, corners.vertices.map { bytes[Int($0.position)] })
    }
  }

  /// A model with a color per vertex, simplified if it is large.
  private init(
    colored model: TexturedMesh, _ figures: [VertexFigures], _ options: Options,
    _ context: StageContext
  ) throws {
    let full = try VertexColoring().run(model, context.part(from: 0, to: 0))
    let control = context.control.part(from: 0, to: 0)
    var mesh = full
    var sources = Array(full.positions.indices)
    if full.triangles.count > options.maximumTriangles {
      mesh = try full.simplified(maximumTriangles: options.maximumTriangles, control)
        .withoutUnusedVertices()
      sources = try NearestPoints(of: mesh.positions, in: full.positions, control)
        .indices.map { max(0, Int($0)) }
      mesh.normals = mesh.angleWeightedNormals()
    }
    if mesh.normals.count != mesh.positions.count { mesh.normals = mesh.angleWeightedNormals() }
    self.init(mesh.positions, normals: mesh.normals, triangles: mesh.triangles)
    if full.colors.count == full.positions.count {
      colors = Data(rgb: sources.map { full.colors[$0] })
    }
    parts = [Part(first: 0, count: mesh.triangles.count, texture: nil)]
    maps = figures.map { figure in
      let bytes = figure.bytes
      return Map(figure, sources.map { bytes[$0] })
    }
  }

  init(_ positions: [SIMD3<Float>], normals: [SIMD3<Float>], triangles: [Triangle]) {
    let grid = PositionGrid(positions)
    (origin, size) = (grid.origin, grid.extent)
    self.positions = grid.data(positions)
    self.normals = Self.data(normals: normals)
    var indices: [UInt32] = []
    indices.reserveCapacity(3 * triangles.count)
    for triangle in triangles { for vertex in triangle.vertices { indices.append(UInt32(vertex)) } }
    self.triangles =
      positions.count <= 1 << 16
      ? Data(littleEndian: indices.map(UInt16.init)) : Data(littleEndian: indices)
    (parts, maps) = ([], [])
  }

  /// Those of textures that repeat are beyond 0…1.
  mutating func set(coordinates: [SIMD2<Float>]) {
    let low = coordinates.reduce(SIMD2(0, 0)) { pointwiseMin($0, $1) }
    let high = coordinates.reduce(SIMD2(1, 1)) { pointwiseMax($0, $1) }
    let largest = SIMD2<Float>(repeating: .greatestFiniteMagnitude)
    let size = pointwiseMin(high - low, largest)
    (coordinateOrigin, coordinateSize) = (low, size)
    var numbers: [UInt16] = []
    numbers.reserveCapacity(2 * coordinates.count)
    for coordinate in coordinates {
      let scaled = ((coordinate - low) / size).clamped(lowerBound: .zero, upperBound: .one)
      for axis in 0..<2 { numbers.append(UInt16(saturating: scaled[axis] * 65535)) }
    }
    self.coordinates = Data(littleEndian: numbers)
  }

  private static func data(normals: [SIMD3<Float>]) -> Data {
    var numbers: [Int8] = []
    numbers.reserveCapacity(3 * normals.count)
    for normal in normals {
      let scaled = (normal.normalized * 127).rounded(.toNearestOrAwayFromZero)
      for axis in 0..<3 { numbers.append(Int8(saturating: scaled[axis])) }
    }
    return Data(littleEndian: numbers)
  }
}

extension PageModel.Map {
  init(_ figure: VertexFigures, _ bytes: [UInt8]) {
    self.init(
      key: figure.kind, name: figure.name, unit: figure.unit, high: figure.high,
      values: Data(bytes))
  }
}

/// The vertices of a model as pairs of position and texture coordinate.
private struct CornerVertices {
  struct Vertex: Hashable {
    var position: UInt32
    var coordinate: UInt32
  }

  private(set) var vertices: [Vertex] = []
  private(set) var triangles: [Triangle] = []

  init(_ model: TexturedMesh) {
    var numbers: [Vertex: UInt32] = [:]
    numbers.reserveCapacity(model.textureCoordinates.count)
    func number(_ position: UInt32, _ coordinate: UInt32) -> UInt32 {
      let vertex = Vertex(position: position, coordinate: coordinate)
      if let number = numbers[vertex] { return number }
      numbers[vertex] = UInt32(vertices.count)
      vertices.append(vertex)
      return UInt32(vertices.count - 1)
    }
    for (corners, texels) in zip(model.mesh.triangles, model.textureTriangles) {
      triangles.append(
        Triangle(
          number(corners.a, texels.a), number(corners.b, texels.b), number(corners.c, texels.c)))
    }
  }
}
