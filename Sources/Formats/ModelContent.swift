import SceneModel

/// A texture map encoded as an image file.
package struct EncodedTexture: Equatable, Sendable {
  package var map: TextureMap
  package var image: EncodedImage

  package init(map: TextureMap, image: EncodedImage) {
    self.map = map
    self.image = image
  }

  /// The file name of the image for atlas `atlas`, without a folder.
  package func fileName(atlas: Int) -> String {
    let stem =
      switch map {
      case .diffuseColor: "tex"
      case .normal: "norm"
      case .ambientOcclusion: "ao"
      case .roughness: "roughness"
      case .displacement: "disp"
      }
    return "\(ModelContent.name)_\(stem)\(atlas).\(image.fileExtension)"
  }
}

/// The content of an exported model: a mesh and the encoded images of its atlases.
package struct ModelContent: Sendable {
  /// The name of every model, of its root prim, and the stem of its file names, as in the files of
  /// Object Capture.
  package static let name = "baked_mesh"
  /// The roughness of a material without a roughness map, 0…1.
  static let defaultRoughness = 0.9

  package var mesh: TexturedMesh
  /// The images of every atlas of the mesh; those in `mesh.atlases` are ignored.
  package var textures: [[EncodedTexture]]
  /// The creator of the model, for the metadata.
  package var creator: String

  package init(mesh: TexturedMesh, textures: [[EncodedTexture]], creator: String) {
    self.mesh = mesh
    self.textures = textures.map { $0.sorted { $0.map < $1.map } }
    self.creator = creator
  }

  /// The parts of the mesh, one per atlas; without atlases a single part.
  package var parts: [MeshPart] {
    let ranges =
      mesh.atlases.isEmpty
      ? [0..<mesh.mesh.triangles.count] : mesh.atlases.map(\.triangles)
    guard ranges.count > 1 else { return [MeshPart(whole: mesh)] }
    return mesh.atlases.map { MeshPart(mesh, of: $0) }
  }

  /// The name of part `index` and of its material.
  static func partName(_ index: Int) -> String { "g\(index)" }

  /// The images of part `index`; none if there are fewer sets than parts.
  package func textures(ofPart index: Int) -> [EncodedTexture] {
    textures.indices.contains(index) ? textures[index] : []
  }
}

/// A self-contained mesh with the triangles of one atlas.
package struct MeshPart: Equatable, Sendable {
  /// World frame.
  package var positions: [SIMD3<Float>] = []
  /// One per position; empty if the mesh has none.
  package var normals: [SIMD3<Float>] = []
  /// Origin at the bottom left.
  package var textureCoordinates: [SIMD2<Float>] = []
  /// Indices into `positions`.
  package var triangles: [Triangle] = []
  /// Indices into `textureCoordinates`, parallel to `triangles`; empty without texture.
  package var textureTriangles: [Triangle] = []
  /// Number of quads, each formed by two of the first triangles; see `TextureAtlas`.
  package var quadCount = 0

  /// All of `mesh`, unchanged.
  init(whole mesh: TexturedMesh) {
    positions = mesh.mesh.positions
    normals = mesh.mesh.normals
    textureCoordinates = mesh.textureCoordinates
    triangles = mesh.mesh.triangles
    textureTriangles = mesh.textureTriangles
    quadCount = mesh.atlases.first?.quadCount ?? 0
  }

  /// The triangles of `atlas` with the vertices and coordinates that they use, renumbered in order
  /// of first use.
  init(_ mesh: TexturedMesh, of atlas: TextureAtlas) {
    quadCount = atlas.quadCount
    var vertices = Renumbering(count: mesh.mesh.positions.count)
    var coordinates = Renumbering(count: mesh.textureCoordinates.count)
    for index in atlas.triangles {
      triangles.append(vertices.triangle(mesh.mesh.triangles[index]))
      textureTriangles.append(coordinates.triangle(mesh.textureTriangles[index]))
    }
    positions = vertices.order.map { mesh.mesh.positions[$0] }
    if mesh.mesh.normals.count == mesh.mesh.positions.count {
      normals = vertices.order.map { mesh.mesh.normals[$0] }
    }
    textureCoordinates = coordinates.order.map { mesh.textureCoordinates[$0] }
  }
}

/// Renumbers indices in order of their first use.
private struct Renumbering {
  private(set) var order: [Int] = []
  private var numbers: [UInt32]

  init(count: Int) { numbers = [UInt32](repeating: .max, count: count) }

  mutating func triangle(_ t: Triangle) -> Triangle {
    Triangle(number(t.a), number(t.b), number(t.c))
  }

  private mutating func number(_ index: UInt32) -> UInt32 {
    if numbers[Int(index)] == .max {
      numbers[Int(index)] = UInt32(order.count)
      order.append(Int(index))
    }
    return numbers[Int(index)]
  }
}
