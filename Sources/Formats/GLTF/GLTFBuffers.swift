import Foundation

/// The buffers and buffer views of an untrusted glTF file.
struct GLTFBuffers {
  let content: GLTFContent
  let budget: MemoryBudget
  private let binary: [UInt8]
  private let files: RelatedFiles
  private let decoder: (any GLTFMeshDecoder)?
  /// What was loaded or decompressed before.
  private var buffers: [Int: [UInt8]] = [:]
  private var decompressed: [Int: [UInt8]] = [:]

  init(
    _ content: GLTFContent, binary: [UInt8], files: RelatedFiles,
    decoder: (any GLTFMeshDecoder)?, budget: MemoryBudget
  ) {
    (self.content, self.binary, self.files) = (content, binary, files)
    (self.decoder, self.budget) = (decoder, budget)
  }

  /// An element of one of the lists of a file. Throws a `FormatFault` without it.
  static func element<Element>(_ list: [Element]?, _ index: Int, _ kind: String) throws -> Element {
    guard let list, list.indices.contains(index) else {
      throw FormatFault("it refers to \(kind) \(index), which does not exist")
    }
    return list[index]
  }

  /// The bytes of a view, decompressed. Throws a `FormatFault`, or an `UnsupportedFeature`.
  mutating func view(_ index: Int) throws -> ArraySlice<UInt8> {
    let view = try Self.element(content.bufferViews, index, "buffer view")
    if let compressed = view.extensions?.meshopt {
      let bytes = try decompressed[index] ?? decompress(compressed)
      decompressed[index] = bytes
      return bytes[...]
    }
    return try slice(view.buffer, view.byteOffset, view.byteLength)
  }

  private mutating func slice(
    _ buffer: Int, _ offset: Int?, _ length: Int
  ) throws -> ArraySlice<UInt8> {
    let bytes = try self.buffer(buffer)
    let start = offset ?? 0
    guard start >= 0, length >= 0, start <= bytes.count, length <= bytes.count - start else {
      throw FormatFault("a buffer view ends after its buffer")
    }
    return bytes[start..<start + length]
  }

  private mutating func buffer(_ index: Int) throws -> [UInt8] {
    if let bytes = buffers[index] { return bytes }
    let buffer = try Self.element(content.buffers, index, "buffer")
    guard let uri = buffer.uri else {
      guard index == 0 else { throw FormatFault("its buffer \(index) has no data") }
      return binary
    }
    guard let bytes = file(uri) else {
      throw FormatFault("its buffer \(uri.prefix(100)) is missing")
    }
    buffers[index] = bytes
    return bytes
  }

  /// The bytes of an embedded or external file; nil if it is missing.
  func file(_ uri: String) -> [UInt8]? {
    if uri.hasPrefix("data:") {
      guard let comma = uri.firstIndex(of: ","), uri[..<comma].hasSuffix(";base64") else {
        return nil
      }
      return Data(base64Encoded: String(uri[uri.index(after: comma)...])).map { [UInt8]($0) }
    }
    let bytes = files.contents(of: uri.removingPercentEncoding ?? uri)
    budget.extend(byFileOf: bytes?.count ?? 0)
    return bytes
  }
}

// MARK: - Compression

extension GLTFBuffers {
  private mutating func decompress(_ view: GLTFContent.CompressedView) throws -> [UInt8] {
    guard let decoder else {
      throw UnsupportedFeature(
        reason: "its meshes are compressed with EXT_meshopt_compression",
        remedy: "Export it without compression.")
    }
    let encoded = Array(try slice(view.buffer, view.byteOffset, view.byteLength))
    try budget.spend(view.count, of: max(view.byteStride, 4))
    do {
      switch view.mode {
      case "ATTRIBUTES":
        guard view.byteStride > 0, view.byteStride <= 256, view.byteStride % 4 == 0 else {
          throw FormatFault("a compressed view has vertices of \(view.byteStride) bytes")
        }
        var bytes = try decoder.vertices(encoded, count: view.count, stride: view.byteStride)
        try MeshoptFilter.apply(view.filter, to: &bytes, stride: view.byteStride)
        return bytes
      case "TRIANGLES":
        let indices = try decoder.triangles(encoded, indexCount: view.count)
        return view.byteStride == 2
          ? Self.bytes(indices) { UInt16(truncatingIfNeeded: $0) }
          : Self.bytes(indices) { $0 }
      default:
        throw UnsupportedFeature(
          reason: "it has compressed views of the mode \(view.mode)",
          remedy: "Export it without compression.")
      }
    } catch let fault as FormatFault {
      throw fault
    } catch let feature as UnsupportedFeature {
      throw feature
    } catch {
      throw FormatFault("its compressed meshes are damaged")
    }
  }

  private static func bytes<Number>(
    _ indices: [UInt32], _ number: (UInt32) -> Number
  ) -> [UInt8] {
    indices.map(number).withUnsafeBytes { Array($0) }
  }
}
