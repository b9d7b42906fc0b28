import Foundation
import SceneModel
import Testing

@testable import Formats

@Suite struct USDCrateReadingTests {
  private func decode(_ bytes: [UInt8]) throws -> USDLayer {
    try USDCrate.decode(bytes, budget: MemoryBudget(forFileOf: bytes.count))
  }

  /// A layer with every kind of value that is read.
  private static var layer: USDLayer {
    var prim = USDPrim("Mesh", "shape")
    prim.apiSchemas = ["MaterialBindingAPI"]
    prim.metadata = [
      USDField("kind", .token("component")),
      USDField("references", .references([USDReference(asset: "a.usd", path: "/shape/inner")])),
    ]
    let values: [(String, USDValue)] = [
      ("bool", .bool(true)), ("int", .int(-5)), ("float", .float(0.1)), ("double", .double(0.1)),
      ("half", .double(0.5)), ("string", .string("é")), ("token", .token("t")),
      ("asset", .asset("0/a b.png")), ("float2", .float2([0.5, 1])),
      ("float3", .float3([1, -2, 3])),
      ("float4", .float4([1, 2, 3, 0.25])), ("double3", .double3([0.1, 2, 3])),
      ("matrix4d", .matrix4((0..<16).map { Double($0) / 3 })),
      ("token[]", .tokenArray(["a", "b", "a"])), ("int[]", .intArray([3, 1, 2])),
      ("long", .intArray((0..<3000).map { Int32($0 &* $0 &- 70_000) })), ("none", .intArray([])),
      ("float[]", .floatArray([0.5, .infinity])), ("float2[]", .float2Array([[1, 2], [3, 4]])),
      ("float3[]", .float3Array([[1, 2, 3], [4, 5, 6]])),
      ("float4[]", .float4Array([[1, 2, 3, 4]])),
    ]
    prim.properties = values.map { .attribute($0.0, "p:\($0.0)", $0.1) }
    prim.properties += [
      .attribute("float", "uniform", .float(1), isUniform: true),
      .attribute(
        "float3[]", "meta", .float3Array([]),
        metadata: [USDField("interpolation", .token("vertex"))]),
      .connection("color3f", "inputs:c", to: "/shape/inner.outputs:rgb"),
      .relationship("material:binding", ["/shape", "/shape/inner"]),
    ]
    prim.children = [USDPrim("Scope", "inner"), USDPrim("", "other")]
    prim.children[1].specifier = .over
    return USDLayer(
      metadata: [USDField("metersPerUnit", .double(0.01)), USDField("upAxis", .token("Z"))],
      defaultPrim: "shape", prims: [prim, USDPrim("Xform", "second")])
  }

  @Test func layersRoundTrip() throws {
    #expect(try decode(USDCrate.encode(Self.layer)) == Self.layer)
  }

  // MARK: Arrays

  /// Reads an array that is appended to a valid file, which has the version 0.`version`.
  private func array(
    _ type: CrateType, _ content: ByteWriter, version: UInt8 = 8, isCompressed: Bool = true
  ) throws -> USDValue? {
    var bytes = USDCrate.encode(Self.layer)
    bytes[9] = version
    let rep = CrateValueRep.array(type, at: bytes.count, isCompressed: isCompressed)
    bytes += content.bytes
    let budget = MemoryBudget(forFileOf: bytes.count)
    let file = try CrateFile(bytes)
    let tables = try CrateTables(file, budget: budget)
    return try CrateValueReader(file: file, tables: tables, budget: budget).value(rep)
  }

  private func appendCounted(_ integers: [Int32], to writer: inout ByteWriter) {
    let compressed = CrateCompression.compress(integers)
    writer.append(UInt64(compressed.count))
    writer.append(contentsOf: compressed)
  }

  private let integers = (0..<100).map { Int32($0 % 7 - 3) }

  @Test(arguments: [CrateType.half, .float, .double])
  func numbersAsIntegers(type: CrateType) throws {
    var content = ByteWriter()
    content.append(UInt64(integers.count))
    content.append(UInt8(ascii: "i"))
    appendCounted(integers, to: &content)
    #expect(try array(type, content) == .floatArray(integers.map { Float($0) }))
  }

  @Test(arguments: [CrateType.half, .float, .double])
  func numbersFromATable(type: CrateType) throws {
    var content = ByteWriter()
    content.append(UInt64(integers.count))
    content.append(UInt8(ascii: "t"))
    content.append(UInt32(2))
    // 0.5 and −2.
    switch type {
    case .half: [UInt16(0x3800), 0xC000].forEach { content.append($0) }
    case .float: [Float(0.5), -2].forEach { content.append($0) }
    default: [0.5, -2.0].forEach { content.append($0) }
    }
    let table = content
    appendCounted(integers.map { $0 & 1 }, to: &content)
    #expect(try array(type, content) == .floatArray(integers.map { $0 & 1 == 0 ? 0.5 : -2 }))
    content = table
    appendCounted(integers, to: &content)
    #expect(throws: FormatFault.self) { try array(type, content) }
  }

  @Test func olderVersionsHaveShorterCounts() throws {
    for version: UInt8 in [4, 5, 6, 7] {
      var content = ByteWriter()
      if version < 5 { content.append(UInt32(1)) }
      if version < 7 { content.append(UInt32(3)) } else { content.append(UInt64(3)) }
      for value: Float in [1, 2, 3] { content.append(value) }
      #expect(
        try array(.float, content, version: version, isCompressed: false)
          == .floatArray([1, 2, 3]))
    }
    #expect(throws: UnsupportedFeature.self) { try array(.float, ByteWriter(), version: 3) }
  }

  @Test func halvesAreConverted() throws {
    let halves: [(UInt16, Float)] = [
      (0, 0), (0x3C00, 1), (0xC000, -2), (1, 0x1p-24), (0x03FF, 1023 * 0x1p-24), (0x7BFF, 65504),
      (0x7C00, .infinity), (0x8000, -0.0), (0x3555, 0.333_251_95),
    ]
    for (bits, value) in halves { #expect(HalfFloat(bitPattern: bits).float == value) }
    #expect(HalfFloat(bitPattern: 0x7E00).float.isNaN)
  }

  @Test func longIntegersRoundTrip() throws {
    // A difference of each size: the common one, then of 2, 4 and 8 bytes.
    var content = ByteWriter()
    content.append(Int64(3))
    content.append(UInt8(0b11_10_01_00))
    content.append(UInt16(bitPattern: -2))
    content.append(Int32(100_000))
    content.append(Int64(1) << 40)
    let compressed = CrateCompression.compress(content.bytes)
    #expect(
      try CrateCompression.decompress(compressed[...], count: 4, as: Int64.self)
        == [3, 1, 100_001, 100_001 + 1 << 40])
  }

  // MARK: Damage

  @Test(arguments: [Int64.max, 1 << 40, 1 << 31, -1])
  func impossibleCountsAreRefused(count: Int64) throws {
    for type in [CrateType.int, .float, .float3, .token, .int64, .double4] {
      for isCompressed in [false, true] {
        var content = ByteWriter()
        content.append(count)
        content.append(UInt8(ascii: "i"))
        content.append(count)
        #expect(throws: (any Error).self) {
          try array(type, content, isCompressed: isCompressed)
        }
      }
    }
  }

  @Test func circlesOfPathsAreRefused() throws {
    for jumps: [Int32] in [
      [1, -2, -2], [-1, 0, 0], [1_000_000, -1, -2], [-1, -1, -1], [0, 0, -2],
    ] {
      #expect(throws: FormatFault.self) {
        try CratePathTable(count: 3, paths: [0, 1, 1], tokens: [0, 1, 2], jumps: jumps)
      }
    }
    let deep = 10_000
    #expect(throws: FormatFault.self) {
      try CratePathTable(
        count: deep, paths: (0..<UInt32(deep)).map { $0 },
        tokens: [Int32](repeating: 1, count: deep), jumps: [Int32](repeating: -1, count: deep))
    }
  }

  @Test(arguments: CrateCompressionTests.inputs.indices)
  func blocksAreDecompressed(_ index: Int) throws {
    let input = CrateCompressionTests.inputs[index]
    let block = LZ4Block.compress(input)
    #expect(try LZ4Block.decompress(block[...], maximumCount: input.count) == input)
    guard input.count > 1 else { return }
    #expect(throws: FormatFault.self) {
      try LZ4Block.decompress(block[...], maximumCount: input.count - 1)
    }
  }
}
