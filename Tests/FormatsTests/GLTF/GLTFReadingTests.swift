import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

/// Files as other programs write them.
@Suite struct GLTFReadingTests {
  /// Bytes as a data URI.
  private static func uri(_ bytes: [UInt8]) -> String {
    "data:application/octet-stream;base64,\(Data(bytes).base64EncodedString())"
  }

  /// Three positions at offset 0, three normalized texture coordinates at 36, three normalized
  /// colors with stride 4 at 48, indices of a byte at 60.
  private static let buffer: [UInt8] = {
    var writer = ByteWriter()
    let points: [SIMD3<Float>] = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    for point in points { writer.append(point) }
    for value: UInt16 in [0, 0, 65535, 0, 0, 65535] { writer.append(value) }
    for color: [UInt8] in [[255, 0, 0, 9], [0, 255, 0, 9], [0, 0, 55, 9]] {
      writer.append(contentsOf: color)
    }
    writer.append(contentsOf: [0, 1, 2, 2, 1, 0])
    return writer.bytes
  }()

  /// A parent that scales, with two children of the same mesh: one is moved, one mirrored.
  static let foreign = """
    {
      "asset": {"version": "2.0"}, "scene": 0,
      "scenes": [{"nodes": [0]}],
      "nodes": [
        {"scale": [2, 2, 2], "children": [1, 2]},
        {"mesh": 0, "translation": [1, 2, 3], "rotation": [0, 0, 0.70710678, 0.70710678]},
        {"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}
      ],
      "meshes": [{"primitives": [
        {"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 2}, "indices": 3, "material": 0},
        {"attributes": {"POSITION": 0}, "mode": 1}
      ]}],
      "materials": [{"pbrMetallicRoughness": {
        "baseColorFactor": [0.5, 0.25, 1, 1],
        "baseColorTexture": {"index": 0, "extensions": {
          "KHR_texture_transform": {"offset": [0.5, 0], "scale": [0.5, 1]}}}
      }}],
      "textures": [{"source": 0}],
      "images": [{"uri": "\(uri(Sample.image(7).bytes))"}],
      "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5123, "normalized": true, "count": 3, "type": "VEC2"},
        {"bufferView": 2, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC3"},
        {"bufferView": 3, "componentType": 5121, "count": 3, "type": "SCALAR"}
      ],
      "bufferViews": [
        {"buffer": 0, "byteLength": 36},
        {"buffer": 0, "byteOffset": 36, "byteLength": 12},
        {"buffer": 0, "byteOffset": 48, "byteLength": 12, "byteStride": 4},
        {"buffer": 0, "byteOffset": 60, "byteLength": 6}
      ],
      "buffers": [{"byteLength": 66, "uri": "\(uri(buffer))"}]
    }
    """

  private func read(_ text: String) throws -> LoadedModel {
    let folder = try TemporaryFolder()
    return try ModelFile.read(try folder.write(text, as: "model.gltf"))
  }

  private func replacing(_ old: String, _ new: String) throws -> String {
    try #require(Self.foreign.contains(old))
    return Self.foreign.replacingOccurrences(of: old, with: new)
  }

  @Test func nodesAreTransformed() throws {
    let model = try read(Self.foreign)
    // Lines are ignored.
    try #require(model.parts.count == 2)
    let rotated = model.parts[0].positions
    for (found, expected) in zip(rotated, [[2, 4, 6], [2, 6, 6], [0, 4, 6]] as [SIMD3<Float>]) {
      #expect((found - expected).length < 1e-6)
    }
    #expect(model.parts[0].triangles == [Triangle(0, 1, 2)])
    #expect(model.parts[1].positions == [[0, 0, 0], [-2, 0, 0], [0, 2, 0]])
    // A reflection keeps the side that is outside.
    #expect(model.parts[1].triangles == [Triangle(0, 2, 1)])
  }

  @Test func attributesAreNormalizedAndConverted() throws {
    let part = try #require(try read(Self.foreign).parts.first)
    #expect(part.baseColor == Sample.image(7))
    #expect(part.baseColorFactor == [0.5, 0.25, 1])
    #expect(part.textureCoordinates == [[0.5, 1], [1, 1], [0.5, 0]])
    #expect(part.colors == [[255, 0, 0], [0, 255, 0], [0, 0, 128]])
    #expect(part.normals.isEmpty)
  }

  @Test func stripsAndFansAreTriangles() throws {
    let indices = #""indices": 3, "material": 0}"#
    let six = try replacing(
      #"5121, "count": 3, "type": "SCALAR""#, #"5121, "count": 6, "type": "SCALAR""#)
    for (mode, expected) in [
      (5, [Triangle(0, 1, 2), Triangle(1, 2, 2), Triangle(2, 2, 1), Triangle(2, 0, 1)]),
      (6, [Triangle(0, 1, 2), Triangle(0, 2, 2), Triangle(0, 2, 1), Triangle(0, 1, 0)]),
    ] {
      let text = six.replacingOccurrences(
        of: indices, with: #""indices": 3, "mode": \#(mode), "material": 0}"#)
      #expect(try read(text).parts[0].triangles == expected)
    }
  }

  @Test func externalFilesAreFound() throws {
    let folder = try TemporaryFolder()
    try folder.write(Self.buffer, as: "data/my buffer.bin")
    try folder.write(Sample.image(3).bytes, as: "color.png")
    let text = try replacing(Self.uri(Self.buffer), "data/my%20buffer.bin")
      .replacingOccurrences(of: Self.uri(Sample.image(7).bytes), with: #"C:\\work\\color.png"#)
    let model = try ModelFile.read(try folder.write(text, as: "model.gltf"))
    #expect(model.parts[0].baseColor == Sample.image(3) && model.missingFiles == [])
    let other = try TemporaryFolder()
    try other.write(Self.buffer, as: "data/my buffer.bin")
    let incomplete = try ModelFile.read(try other.write(text, as: "model.gltf"))
    #expect(incomplete.parts[0].baseColor == nil)
    #expect(incomplete.missingFiles == [#"C:\work\color.png"#])
  }

  @Test func circlesAndManyCopiesAreRefused() throws {
    let circle = try replacing(#""children": [1, 2]"#, #""children": [1, 2, 0]"#)
    #expect(throws: FormatError.self) { try read(circle) }
    // Every level has two references to the next.
    let nodes = (0..<60).map { #"{"children": [\#($0 + 1), \#($0 + 1)]}"# } + [#"{"mesh": 0}"#]
    let start = try #require(
      Self.foreign.range(of: #""nodes": [\#n"#.replacingOccurrences(of: "\\n", with: "\n")))
    let end = try #require(Self.foreign.range(of: #""meshes""#))
    let doubled = Self.foreign.replacingCharacters(
      in: start.lowerBound..<end.lowerBound, with: #""nodes": [\#(nodes.joined(separator: ","))], "#
    )
    #expect(throws: FormatError.self) { try read(doubled) }
  }

  @Test(arguments: [
    (#""count": 3, "type": "VEC3""#, #""count": 9223372036854775807, "type": "VEC3""#),
    (#""count": 3, "type": "VEC3""#, #""count": -1, "type": "VEC3""#),
    (#""byteStride": 4"#, #""byteStride": -4"#), (#""byteOffset": 60"#, #""byteOffset": -60"#),
    (#""byteOffset": 60"#, #""byteOffset": 9223372036854775807"#),
    (#""bufferView": 3"#, #""bufferView": -1"#), (#""mesh": 0"#, #""mesh": 1"#),
    (#""scene": 0"#, #""scene": 1"#), (#""indices": 3"#, #""indices": 0"#),
    (#""count": 3, "type": "SCALAR""#, #""count": 3, "type": "VEC9""#),
    (#""POSITION": 0"#, #""POSITION": 1"#), (#""translation": [1,"#, #""translation": [1e308,"#),
    (
      #""scene": 0"#, #""extensionsRequired": ["KHR_draco_mesh_compression"], "scene": 0"#
    ),
  ]) func invalidNumbersAreRefused(old: String, new: String) throws {
    let text = try replacing(old, new)
    #expect(throws: FormatError.self) { try read(text) }
  }

  @Test func filtersAreDecoded() throws {
    var normals: [UInt8] = []
    let vectors = [[0, 0, 1], [0, 0, -1], [1, 0, 0], [0.6, -0.8, 0]] as [SIMD3<Float>]
    for vector in vectors { normals += OctahedralNormal.encode(vector) }
    try MeshoptFilter.apply("OCTAHEDRAL", to: &normals, stride: 4)
    for (index, vector) in vectors.enumerated() {
      for axis in 0..<3 {
        let value = Float(Int8(bitPattern: normals[4 * index + axis])) / 127
        #expect(abs(value - vector[axis]) < 0.02)
      }
    }
    // 3 · 2⁻² and −5 · 2¹.
    var numbers: [UInt8] = [3, 0, 0, 0xFE, 0xFB, 0xFF, 0xFF, 1]
    try MeshoptFilter.apply("EXPONENTIAL", to: &numbers, stride: 8)
    var cursor = ByteCursor(numbers)
    #expect(try cursor.values(Float.self, count: 2) == [0.75, -10])
    #expect(throws: UnsupportedFeature.self) {
      try MeshoptFilter.apply("QUATERNION", to: &numbers, stride: 8)
    }
  }
}
