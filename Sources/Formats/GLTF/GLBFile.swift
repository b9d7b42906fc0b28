import Foundation
import SceneModel

/// Models as one glTF 2.0 file (Khronos Group, ISO/IEC 12113), in the binary form with embedded
/// images. Deterministic.
///
/// glTF is right-handed, y up and in meters, as is the world frame. Each atlas has a primitive and
/// a material. Not metallic; roughness is 0.9 without a map. Core glTF doesn't support
/// displacement. Tangents are omitted: the normal map is baked for Mikkelsen's tangent space, which
/// viewers derive if a file has none.
///
/// With a mesh encoder, vertices and triangles are quantized and compressed without a fallback:
/// readers must support `KHR_mesh_quantization` and `EXT_meshopt_compression`.
package enum GLBFile {
  /// Writes `mesh`, with a material for each of its atlases; throws `OutputError`.
  package static func write(
    _ mesh: TexturedMesh, materials: [GLTFMaterial], creator: String,
    compressedBy encoder: (any GLTFMeshEncoder)? = nil, to url: URL
  ) throws {
    let bytes = try encode(
      mesh, materials: materials, creator: creator, compressedBy: encoder, path: url.path)
    try AtomicFile.write(bytes, to: url)
  }

  /// The bytes that `write` writes; `path` is the file's path in errors.
  package static func encode(
    _ mesh: TexturedMesh, materials: [GLTFMaterial], creator: String,
    compressedBy encoder: (any GLTFMeshEncoder)? = nil, path: String = "model.glb"
  ) throws -> [UInt8] {
    var builder = GLTFBuilder()
    let grid = encoder == nil ? nil : PositionGrid(mesh.mesh.positions)
    let all = 0..<mesh.mesh.triangles.count
    let ranges = mesh.atlases.isEmpty ? [all] : mesh.atlases.map(\.triangles)
    for (index, range) in ranges.enumerated() where !range.isEmpty {
      let material = materials.indices.contains(index) ? materials[index] : GLTFMaterial()
      let primitive = IndexedTriangles(mesh, triangles: range)
      if let encoder, let grid {
        let quantized = try QuantizedPrimitive(primitive, of: mesh, in: grid, orderedBy: encoder)
        try builder.append(quantized, material, encodedBy: encoder)
      } else {
        builder.append(primitive, of: mesh, material)
      }
    }
    let json = JSONEncoder()
    json.outputFormatting = [.sortedKeys, .withoutEscapingSlashes]
    let document = builder.document(name: ModelContent.name, generator: creator, grid: grid)
    return try container(
      json: [UInt8](try json.encode(document)), binary: builder.binary, path: path)
  }

  /// A header and two chunks padded to multiples of four bytes; without binary data only the first.
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
