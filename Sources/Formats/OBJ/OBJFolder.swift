import Foundation
import SceneModel

/// Models as a folder with OBJ, MTL, USDA and the texture images.
package enum OBJFolder {
  /// Writes `model` into `folder`, which is created if missing; other files in it are kept. Throws
  /// `OutputError`.
  package static func write(_ model: ModelContent, to folder: URL) throws {
    let name = ModelContent.name
    try AtomicDirectory.write(to: folder) { temporary in
      func write(_ text: String, _ file: String) throws {
        try AtomicFile.write(Data(text.utf8), to: temporary.appendingPathComponent(file))
      }
      try write(object(model), "\(name).obj")
      try write(materials(model), "\(name).mtl")
      let layer = USDModelLayer(textureFolder: "").layer(model)
      try write(USDAText.encode(layer), "\(name).usda")
      for index in model.parts.indices {
        for texture in model.textures(ofPart: index) {
          let file = temporary.appendingPathComponent(texture.fileName(atlas: index))
          try AtomicFile.write(texture.image.bytes, to: file)
        }
      }
    }
  }

  /// The text of the OBJ file.
  static func object(_ model: ModelContent) -> String {
    let mesh = model.mesh
    var text = "# \(model.creator)\nmtllib \(ModelContent.name).mtl\n"
    for p in mesh.mesh.positions { text += "v \(p.x) \(p.y) \(p.z)\n" }
    for st in mesh.textureCoordinates { text += "vt \(st.x) \(st.y)\n" }
    let hasNormals = mesh.mesh.normals.count == mesh.mesh.positions.count
    if hasNormals { for n in mesh.mesh.normals { text += "vn \(n.x) \(n.y) \(n.z)\n" } }
    let hasTexture = mesh.textureTriangles.count == mesh.mesh.triangles.count
    func corner(_ vertex: UInt32, _ st: UInt32?) -> String {
      let texture = st.map { "\($0 + 1)" } ?? ""
      let normal = hasNormals ? "/\(vertex + 1)" : ""
      return texture.isEmpty && normal.isEmpty
        ? "\(vertex + 1)" : "\(vertex + 1)/\(texture)\(normal)"
    }
    let whole = TextureAtlas(triangles: 0..<mesh.mesh.triangles.count, maps: [:])
    for (part, atlas) in (mesh.atlases.isEmpty ? [whole] : mesh.atlases).enumerated() {
      let name = ModelContent.partName(part)
      text += "g \(name)\nusemtl \(name)\n"
      for index in stride(from: atlas.halves.lowerBound, to: atlas.halves.upperBound, by: 2) {
        let corners = mesh.mesh.triangles[index].quad(with: mesh.mesh.triangles[index + 1])
        let st = mesh.textureTriangles[index].quad(with: mesh.textureTriangles[index + 1])
        text += "f \(zip(corners, st).map { corner($0, $1) }.joined(separator: " "))\n"
      }
      for index in atlas.halves.upperBound..<atlas.triangles.upperBound {
        let t = mesh.mesh.triangles[index]
        let st = hasTexture ? mesh.textureTriangles[index] : nil
        text += "f \(corner(t.a, st?.a)) \(corner(t.b, st?.b)) \(corner(t.c, st?.c))\n"
      }
    }
    return text
  }

  /// The text of the MTL file.
  static func materials(_ model: ModelContent) -> String {
    var text = "# \(model.creator)\n"
    for index in model.parts.indices {
      text += "newmtl \(ModelContent.partName(index))\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\n"
      for texture in model.textures(ofPart: index) {
        let keyword =
          switch texture.map {
          case .diffuseColor: "map_Kd"
          case .normal: "norm"
          case .ambientOcclusion: "map_Ka"
          case .roughness: "map_Pr"
          case .displacement: "disp"
          }
        text += "\(keyword) \(texture.fileName(atlas: index))\n"
      }
    }
    return text
  }
}
