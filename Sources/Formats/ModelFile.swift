import Foundation
import SceneModel

/// Models in any of the formats that this module reads.
package enum ModelFile {
  /// The formats of files by their extensions.
  private enum Kind: String {
    case glb, gltf, usdz, usdc, usda, usd, obj, ply

    init?(_ url: URL) { self.init(rawValue: url.pathExtension.lowercased()) }
  }

  /// The formats, for help and messages.
  package static let formats =
    "USDZ, USD, GLB, glTF, OBJ and PLY files, or a folder with an OBJ file"

  /// Reads the surface of a model with its base color. `decoder` is for GLB files that are
  /// compressed with `EXT_meshopt_compression`.
  ///
  /// Throws a `FormatError` if there is no model, or a damaged one.
  package static func read(
    _ url: URL, decompressedBy decoder: (any GLTFMeshDecoder)? = nil
  ) throws -> LoadedModel {
    if url.isExistingFolder {
      let object = try FormatError.naming(url) { try OBJFolder.object(in: url) }
      return try decode(try contents(of: object), of: object)
    }
    if Kind(url) == .ply {
      return try FormatError.naming(url) { try LoadedModel(PLY.readMesh(url)).checked() }
    }
    // An unknown format is reported without reading what may be large.
    return try decode(Kind(url) == nil ? [] : try contents(of: url), of: url, decoder)
  }

  /// The model in the bytes of a file; throws a `FormatError`.
  static func decode(
    _ bytes: [UInt8], of url: URL, _ decoder: (any GLTFMeshDecoder)? = nil
  ) throws -> LoadedModel {
    let files = RelatedFiles(folder: url.deletingLastPathComponent())
    return try FormatError.naming(url) {
      let model =
        switch Kind(url) {
        case .glb, .gltf:
          try GLBFile.decode(bytes, files: files, decompressedBy: decoder)
        case .usdz: try USDZPackage.decode(bytes)
        case .usdc, .usda, .usd:
          try USDFile.decode(bytes, name: url.lastPathComponent, files: files)
        case .obj: try OBJFile.decode(bytes, files: files)
        case .ply, nil:
          throw UnsupportedFeature(
            reason: "its extension is not one of a model", remedy: "Choose one of: \(formats).")
        }
      return try model.checked()
    }
  }
}

extension LoadedModel {
  /// A surface without texture.
  package init(_ mesh: Mesh) {
    var part = Part()
    part.positions = mesh.positions
    part.normals = mesh.normals
    part.colors = mesh.colors
    part.triangles = mesh.triangles
    self.init(parts: [part])
  }
}
