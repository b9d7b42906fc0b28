import Foundation
import SceneModel
import Testing

@testable import Formats

/// Parses a GLB file according to the specification, for tests.
struct GLBReader {
  typealias Object = [String: Any]

  let root: Object
  let binary: [UInt8]

  /// Also checks header, chunks, buffer views and accessors.
  init(_ bytes: [UInt8]) throws {
    var reader = ByteCursor(bytes)
    #expect(try reader.unsigned(4) == 0x4654_6C67)
    #expect(try reader.unsigned(4) == 2)
    #expect(try reader.unsigned(4) == UInt64(bytes.count))
    let jsonLength = Int(try reader.unsigned(4))
    #expect(try reader.unsigned(4) == 0x4E4F_534A)
    #expect(jsonLength % 4 == 0)
    let json = Data(bytes[20..<(20 + jsonLength)])
    root = try #require(try JSONSerialization.jsonObject(with: json) as? Object)
    guard bytes.count > 20 + jsonLength else {
      binary = []
      return
    }
    reader = ByteCursor(bytes, from: 20 + jsonLength)
    let length = Int(try reader.unsigned(4))
    #expect(try reader.unsigned(4) == 0x004E_4942)
    #expect(length % 4 == 0)
    #expect(reader.remaining == length)
    binary = Array(bytes[reader.offset...])
    try checkViews()
  }

  func list(_ name: String) -> [Object] { root[name] as? [Object] ?? [] }

  /// The bytes of a buffer view.
  func view(_ index: Int) throws -> [UInt8] {
    let view = list("bufferViews")[index]
    let start = try #require(view["byteOffset"] as? Int)
    return Array(binary[start..<(start + (try #require(view["byteLength"] as? Int)))])
  }

  /// Buffer views are consecutive, aligned to four bytes and less than four bytes apart.
  private func checkViews() throws {
    var end = 0
    for view in list("bufferViews") {
      let start = try #require(view["byteOffset"] as? Int)
      #expect(start % 4 == 0 && start >= end && start < end + 4)
      end = start + (try #require(view["byteLength"] as? Int))
    }
    let buffers = list("buffers")
    #expect(buffers.count == 1)
    #expect(buffers.first?["byteLength"] as? Int == binary.count)
    #expect(end <= binary.count && binary.count < end + 4)
  }
}

// MARK: - Geometry

extension GLBReader {
  /// A triangle corner with all its attributes.
  struct Corner: Equatable {
    var position: SIMD3<Float>
    var normal: SIMD3<Float>?
    var textureCoordinate: SIMD2<Float>?
  }

  var primitives: [Object] { list("meshes").first?["primitives"] as? [Object] ?? [] }

  /// The numbers of an accessor, which must fill its buffer view.
  func floats(_ accessor: Int, type: String, width: Int) throws -> [[Float]] {
    let object = list("accessors")[accessor]
    #expect(object["componentType"] as? Int == 5126)
    #expect(object["type"] as? String == type)
    let count = try #require(object["count"] as? Int)
    let viewIndex = try #require(object["bufferView"] as? Int)
    #expect(list("bufferViews")[viewIndex]["target"] as? Int == 34962)
    let bytes = try view(viewIndex)
    #expect(bytes.count == 4 * width * count)
    var reader = ByteCursor(bytes)
    return try (0..<count).map { _ in
      try (0..<width).map { _ in Float(bitPattern: UInt32(try reader.unsigned(4))) }
    }
  }

  func indices(of primitive: Object) throws -> [Int] {
    let object = list("accessors")[try #require(primitive["indices"] as? Int)]
    #expect(object["componentType"] as? Int == 5125)
    #expect(object["type"] as? String == "SCALAR")
    let viewIndex = try #require(object["bufferView"] as? Int)
    #expect(list("bufferViews")[viewIndex]["target"] as? Int == 34963)
    let count = try #require(object["count"] as? Int)
    let bytes = try view(viewIndex)
    #expect(bytes.count == 4 * count)
    var reader = ByteCursor(bytes)
    return try (0..<count).map { _ in Int(try reader.unsigned(4)) }
  }

  func positions(of primitive: Object) throws -> [SIMD3<Float>] {
    let attributes = try #require(primitive["attributes"] as? Object)
    let index = try #require(attributes["POSITION"] as? Int)
    return try floats(index, type: "VEC3", width: 3).map { SIMD3($0) }
  }

  /// Corners in index order; texture coordinates as stored.
  func corners(of primitive: Object) throws -> [Corner] {
    let attributes = try #require(primitive["attributes"] as? Object)
    let positions = try positions(of: primitive)
    let normals = try (attributes["NORMAL"] as? Int)
      .map { try floats($0, type: "VEC3", width: 3) }
    let coordinates = try (attributes["TEXCOORD_0"] as? Int)
      .map { try floats($0, type: "VEC2", width: 2) }
    return try indices(of: primitive).map { index in
      Corner(
        position: positions[index], normal: normals.map { SIMD3($0[index]) },
        textureCoordinate: coordinates.map { SIMD2($0[index]) })
    }
  }
}

// MARK: - Material

extension GLBReader {
  /// The image and media type of a texture reference of material `index`.
  func image(_ material: Int, _ path: String...) throws -> (mediaType: String, bytes: [UInt8])? {
    var object: Object? = list("materials")[material]
    for name in path { object = object?[name] as? Object }
    guard let object else { return nil }
    let texture = list("textures")[try #require(object["index"] as? Int)]
    #expect(texture["sampler"] as? Int == 0)
    let image = list("images")[try #require(texture["source"] as? Int)]
    let viewIndex = try #require(image["bufferView"] as? Int)
    #expect(list("bufferViews")[viewIndex]["target"] == nil)
    return (try #require(image["mimeType"] as? String), try view(viewIndex))
  }
}
