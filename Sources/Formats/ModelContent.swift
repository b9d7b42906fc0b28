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
  /// The roughness of a material without a roughness map, 0…1. Chosen: as in `MapBaking`.
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
