import Foundation

extension GLBFile {
  /// Extensions that change geometry. Files that do not require them have plain geometry, too.
  private static let unsupportedExtensions = [
    "KHR_draco_mesh_compression", "KHR_meshopt_compression", "EXT_mesh_gpu_instancing",
  ]

  /// The model in a file of glTF 2.0: binary, or JSON with buffers and images in the file or in
  /// `files`. `decoder` is for meshes that are compressed with `EXT_meshopt_compression`.
  ///
  /// Throws a `FormatFault`, an `UnsupportedFeature`, or `ByteCursor.Truncated`.
  static func decode(
    _ bytes: [UInt8], files: RelatedFiles, decompressedBy decoder: (any GLTFMeshDecoder)?
  ) throws -> LoadedModel {
    let (json, binary) =
      bytes.starts(with: Array("glTF".utf8)) ? try chunks(of: bytes) : (bytes, [])
    let content = try content(json)
    let required = Set(content.extensionsRequired ?? [])
    if let name = unsupportedExtensions.first(where: required.contains) {
      throw UnsupportedFeature(
        reason: "it requires \(name)", remedy: "Export it without this extension.")
    }
    var buffers = GLTFBuffers(
      content, binary: binary, files: files, decoder: decoder,
      budget: MemoryBudget(forFileOf: bytes.count))
    return try GLTFScene.model(content, &buffers)
  }

  private static func content(_ json: [UInt8]) throws -> GLTFContent {
    do {
      return try JSONDecoder().decode(GLTFContent.self, from: Data(json))
    } catch let error as DecodingError {
      throw FormatFault("its JSON is not valid glTF\(place(of: error))")
    }
  }

  /// Where in the JSON an error is.
  private static func place(of error: DecodingError) -> String {
    let path =
      switch error {
      case .typeMismatch(_, let context), .valueNotFound(_, let context),
        .keyNotFound(_, let context), .dataCorrupted(let context):
        context.codingPath
      @unknown default: [] as [any CodingKey]
      }
    let names = path.map { $0.intValue.map(String.init) ?? $0.stringValue }
    return names.isEmpty ? "" : " at \(names.joined(separator: "."))"
  }

  /// The JSON and the binary chunk.
  private static func chunks(of bytes: [UInt8]) throws -> (json: [UInt8], binary: [UInt8]) {
    var cursor = ByteCursor(bytes, from: 4)
    let version = try cursor.unsigned(4)
    guard version == 2 else {
      throw UnsupportedFeature(
        reason: "it has version \(version) of glTF", remedy: "Export it as glTF 2.0.")
    }
    _ = try cursor.unsigned(4)
    var (json, binary) = (nil as [UInt8]?, nil as [UInt8]?)
    while cursor.remaining >= 8 {
      let size = Int(try cursor.unsigned(4))
      let type = String(decoding: try cursor.take(4), as: UTF8.self)
      let chunk = try cursor.take(size)
      if type == "JSON", json == nil { json = Array(chunk) }
      if type == "BIN\0", binary == nil { binary = Array(chunk) }
    }
    guard let json else { throw FormatFault("it has no JSON chunk") }
    return (json, binary ?? [])
  }
}
