import Foundation
import SceneModel

/// Models as one file of glTF 2.0 (Khronos Group, ISO/IEC 12113), the binary form with the images
/// inside. The same model gives the same bytes.
///
/// glTF is right-handed, y up and in metres, as our world is. A primitive and a material for each
/// atlas. Not metallic; roughness is 0.9 where no map tells it. Displacement has no place in core
/// glTF and is left out. Tangents are left out as well: the normal map is baked for Mikkelsen's
/// tangent space, which viewers derive where a file has none.
package enum GLBFile {
  /// Writes `mesh`, with a material for each of its atlases; throws `OutputError`.
  package static func write(
    _ mesh: TexturedMesh, materials: [GLTFMaterial], creator: String, to url: URL
  ) throws {
    let bytes = try encode(mesh, materials: materials, creator: creator, path: url.path)
    try AtomicFile.write(bytes, to: url)
  }

  /// The bytes that `write` writes; `path` names the file in errors.
  package static func encode(
    _ mesh: TexturedMesh, materials: [GLTFMaterial], creator: String, path: String = "model.glb"
  ) throws -> [UInt8] {
    var builder = GLTFBuilder()
    let all = 0..<mesh.mesh.triangles.count
    let ranges = mesh.atlases.isEmpty ? [all] : mesh.atlases.map(\.triangles)
    for (index, range) in ranges.enumerated() where !range.isEmpty {
      let material = materials.indices.contains(index) ? materials[index] : GLTFMaterial()
      builder.append(IndexedTriangles(mesh, triangles: range), of: mesh, material)
    }
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.sortedKeys, .withoutEscapingSlashes]
    let document = builder.document(name: USDModelLayer.rootName, generator: creator)
    return try container(
      json: [UInt8](try encoder.encode(document)), binary: builder.binary, path: path)
  }

  /// A header and two chunks whose lengths are multiples of four; without data only the first.
  private static func container(
    json: [UInt8], binary: ByteWriter, path: String
  ) throws -> [UInt8] {
    let padding = (4 - json.count % 4) % 4
    let size = 20 + json.count + padding + (binary.count > 0 ? 8 + binary.count : 0)
    guard let length = UInt32(exactly: size) else {
      throw OutputError.tooLarge(path: path, bytes: size)
    }
    var writer = ByteWriter(capacity: size)
    writer.append("glTF")
    writer.append(UInt32(2))
    writer.append(length)
    writer.append(UInt32(json.count + padding))
    writer.append("JSON")
    writer.append(contentsOf: json)
    writer.append(contentsOf: repeatElement(UInt8(ascii: " "), count: padding))
    if binary.count > 0 {
      writer.append(UInt32(binary.count))
      writer.append("BIN\0")
      writer.append(contentsOf: binary.bytes)
    }
    return writer.bytes
  }
}
