import SceneModel

/// The polygons of an untrusted OBJ file, by material.
struct OBJContent {
  /// The polygons of a material. An index of −1 stands for none.
  struct Group {
    struct Corner {
      var position: Int32
      var textureCoordinate: Int32
      var normal: Int32
    }

    var corners: [Corner] = []
    /// The numbers of corners of the polygons.
    var counts: [Int32] = []
  }

  private(set) var positions: [SIMD3<Float>] = []
  /// sRGB; as many as positions, or unused.
  private(set) var colors: [SIMD3<UInt8>] = []
  private(set) var textureCoordinates: [SIMD2<Float>] = []
  private(set) var normals: [SIMD3<Float>] = []
  /// In order of first use.
  private(set) var groups: [(material: String, group: Group)] = []
  /// The names of the MTL files.
  private(set) var libraries: [String] = []

  /// Throws a `FormatFault`.
  init(_ bytes: [UInt8]) throws {
    var lines = TextLines(bytes)
    var indices: [String: Int] = [:]
    var current: Int?
    var name = ""
    while !lines.isAtEnd {
      switch lines.word() {
      case "v": try appendPosition(&lines)
      case "vt":
        let s = try Self.number(&lines)
        textureCoordinates.append(SIMD2(s, Float(lines.number() ?? 0)))
      case "vn": normals.append(try Self.vector(&lines))
      case "f":
        let index = current ?? indices[name] ?? groups.count
        if index == groups.count { groups.append((name, Group())) }
        (indices[name], current) = (index, index)
        try appendFace(&lines, to: index)
      case "usemtl": (name, current) = (lines.rest(), nil)
      case "mtllib": libraries.append(lines.rest())
      default: break
      }
      lines.skipLine()
    }
  }

  private static func number(_ lines: inout TextLines) throws -> Float {
    guard let value = lines.number() else {
      let line = lines.bytes[..<lines.offset].count { $0 == UInt8(ascii: "\n") } + 1
      throw FormatFault("line \(line) lacks a number")
    }
    return Float(value)
  }

  private static func vector(_ lines: inout TextLines) throws -> SIMD3<Float> {
    SIMD3(try number(&lines), try number(&lines), try number(&lines))
  }

  /// A position, possibly followed by a color of 0…1.
  private mutating func appendPosition(_ lines: inout TextLines) throws {
    positions.append(try Self.vector(&lines))
    guard let r = lines.number(), let g = lines.number(), let b = lines.number() else { return }
    func byte(_ value: Double) -> UInt8 {
      value > 0 ? UInt8((min(value, 1) * 255).rounded()) : 0
    }
    colors.append([byte(r), byte(g), byte(b)])
  }

  private mutating func appendFace(_ lines: inout TextLines, to group: Int) throws {
    var count: Int32 = 0
    while lines.skipSpaces(), let position = lines.integer() {
      let slash = UInt8(ascii: "/")
      var (st, normal) = (nil as Int?, nil as Int?)
      if lines.skip(slash) {
        st = lines.integer()
        if lines.skip(slash) { normal = lines.integer() }
      }
      groups[group].group.corners.append(
        Group.Corner(
          position: try Self.index(position, count: positions.count),
          textureCoordinate: try st.map { try Self.index($0, count: textureCoordinates.count) }
            ?? -1,
          normal: try normal.map { try Self.index($0, count: normals.count) } ?? -1))
      count += 1
    }
    groups[group].group.counts.append(count)
  }

  /// The index from 0 of one from 1, or of one that counts back from the end.
  private static func index(_ number: Int, count: Int) throws -> Int32 {
    let index = number > 0 ? number - 1 : count + number
    guard number != 0, index >= 0, let index = Int32(exactly: index) else {
      throw FormatFault("a face has the index \(number), but there are \(count)")
    }
    return index
  }

  /// The part of a group, without its material. Texture coordinates and normals are used if all
  /// corners have them. Throws a `FormatFault`.
  func part(_ group: Group, budget: MemoryBudget) throws -> LoadedModel.Part {
    try budget.spend(positions.count, of: MemoryLayout<UInt32>.stride)
    let corners = group.corners
    let hasTexture = corners.allSatisfy { textureCoordinates.indices ~= Int($0.textureCoordinate) }
    let hasNormals = corners.allSatisfy { normals.indices ~= Int($0.normal) }
    let hasColors = colors.count == positions.count
    var builder = PartBuilder(positions: positions)
    var start = 0
    for count in group.counts {
      let polygon = corners[start..<start + Int(count)].map {
        let position = Int($0.position)
        return PartBuilder.Corner(
          position: position, normal: hasNormals ? normals[Int($0.normal)] : nil,
          textureCoordinate: hasTexture ? textureCoordinates[Int($0.textureCoordinate)] : nil,
          color: hasColors && position < colors.count ? colors[position] : nil)
      }
      start += Int(count)
      try builder.append(polygon)
    }
    return builder.part
  }
}
