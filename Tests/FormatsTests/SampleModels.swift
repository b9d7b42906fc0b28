import Foundation
import SceneModel

@testable import Formats

/// Creates models for the tests of this module.
enum Sample {
  /// A sphere of radius 1 around (0, 1, 0) with `rings` × 2 `rings` cells, in `atlasCount` atlases.
  static func sphere(rings: Int, atlasCount: Int = 1) -> TexturedMesh {
    let columns = 2 * rings
    var mesh = Mesh()
    var coordinates: [SIMD2<Float>] = []
    for ring in 0...rings {
      for column in 0...columns {
        let (u, v) = (Double(column) / Double(columns), Double(ring) / Double(rings))
        let (theta, phi) = (.pi * (1 - v), 2 * .pi * u)
        let normal = SIMD3<Float>(
          Float(sin(theta) * cos(phi)), Float(cos(theta)), Float(-sin(theta) * sin(phi)))
        mesh.positions.append(normal + [0, 1, 0])
        mesh.normals.append(normal)
        coordinates.append([Float(u), Float(v)])
      }
    }
    for ring in 0..<rings {
      for column in 0..<columns {
        let a = UInt32(ring * (columns + 1) + column)
        let c = a + UInt32(columns + 1)
        mesh.triangles.append(Triangle(a, a + 1, c + 1))
        mesh.triangles.append(Triangle(a, c + 1, c))
      }
    }
    let count = mesh.triangles.count
    let atlases = (0..<atlasCount).map {
      TextureAtlas(
        triangles: ($0 * count / atlasCount)..<(($0 + 1) * count / atlasCount), maps: [:])
    }
    return TexturedMesh(
      mesh: mesh, textureCoordinates: coordinates, textureTriangles: mesh.triangles,
      atlases: atlases)
  }

  /// The sphere with placeholder images.
  static func model(rings: Int, atlasCount: Int = 1) -> ModelContent {
    let textures = (0..<atlasCount).map { atlas in
      [TextureMap.ambientOcclusion, .normal, .diffuseColor].map {
        EncodedTexture(
          map: $0,
          image: EncodedImage(fileExtension: "png", bytes: Array("\($0) \(atlas)".utf8)))
      }
    }
    return ModelContent(
      mesh: sphere(rings: rings, atlasCount: atlasCount), textures: textures, creator: "tests")
  }

  /// A base color that readers recognize as PNG.
  static func image(_ atlas: Int) -> EncodedImage {
    EncodedImage(
      fileExtension: "png", bytes: [0x89] + Array("PNG\r\n\u{1A}\n".utf8) + [UInt8(atlas)])
  }

  /// A model whose atlases start with quads, with a base color for each.
  static func colored(rings: Int, atlasCount: Int = 1, quads: Int = 2) -> ModelContent {
    var mesh = sphere(rings: rings, atlasCount: atlasCount)
    for index in mesh.atlases.indices { mesh.atlases[index].quadCount = quads }
    let textures = (0..<atlasCount).map { [EncodedTexture(map: .diffuseColor, image: image($0))] }
    return ModelContent(mesh: mesh, textures: textures, creator: "tests")
  }
}
