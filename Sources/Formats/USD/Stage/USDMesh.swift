import SceneModel

/// The faces of a Mesh prim, with the attributes of their corners.
struct USDMesh {
  let positions: [SIMD3<Float>]
  /// Numbers of corners.
  let counts: [Int32]
  /// For each corner, its position.
  let indices: [Int32]
  /// For each face, its first corner.
  private let starts: [Int]
  private let isLeftHanded: Bool
  private let domain: USDPrimvar<SIMD3<Float>>.Domain
  private let prim: USDPrim

  /// Nil for a mesh without faces; throws a `FormatFault` for invalid ones.
  init?(_ prim: USDPrim, budget: MemoryBudget) throws {
    guard case .float3Array(let points) = prim.value("points"),
      case .intArray(let counts) = prim.value("faceVertexCounts"),
      case .intArray(let indices) = prim.value("faceVertexIndices"), !counts.isEmpty
    else { return nil }
    // Many prims can share the arrays.
    try budget.spend(counts.count, of: MemoryLayout<Int>.stride)
    try budget.spend(indices.count, of: MemoryLayout<Int32>.stride)
    var starts: [Int] = []
    starts.reserveCapacity(counts.count)
    var total = 0
    for count in counts {
      starts.append(total)
      total += Int(max(count, 0))
    }
    guard counts.allSatisfy({ $0 >= 0 }), total == indices.count else {
      throw FormatFault("the mesh \(prim.name) has \(indices.count) corners instead of \(total)")
    }
    guard indices.allSatisfy({ points.indices.contains(Int($0)) }) else {
      throw FormatFault("a face of the mesh \(prim.name) refers to a vertex that does not exist")
    }
    (self.prim, positions, self.counts, self.indices) = (prim, points, counts, indices)
    self.starts = starts
    isLeftHanded = prim.value("orientation")?.text == "leftHanded"
    domain = .init(points: points.count, faces: counts.count, corners: total)
  }

  /// The part of some faces, without its image.
  func part(
    faces: [Int], _ appearance: USDMaterials.Appearance, budget: MemoryBudget
  ) throws -> LoadedModel.Part {
    try budget.spend(positions.count, of: MemoryLayout<UInt32>.stride)
    let attributes = Attributes(prim, appearance, on: domain)
    var builder = PartBuilder(positions: positions)
    for face in faces {
      let corners = starts[face]..<starts[face] + Int(counts[face])
      let polygon = corners.map { corner in
        let point = Int(indices[corner])
        return PartBuilder.Corner(
          position: point,
          normal: attributes.normals?.value(face: face, corner: corner, point: point),
          textureCoordinate: attributes.coordinates.map {
            appearance.transform * $0.value(face: face, corner: corner, point: point)
          },
          color: attributes.colors?.value(face: face, corner: corner, point: point))
      }
      // The first corner stays, so that the fan has the same diagonals.
      try builder.append(
        isLeftHanded ? polygon.prefix(1) + polygon.dropFirst().reversed() : polygon)
    }
    var part = builder.part
    part.baseColorFactor = appearance.factor
    return part
  }
}

/// The attributes of the corners that an appearance needs.
private struct Attributes {
  var normals: USDPrimvar<SIMD3<Float>>?
  var coordinates: USDPrimvar<SIMD2<Float>>?
  var colors: USDPrimvar<SIMD3<UInt8>>?

  init(
    _ prim: USDPrim, _ appearance: USDMaterials.Appearance,
    on domain: USDPrimvar<SIMD3<Float>>.Domain
  ) {
    func primvar<Value>(
      _ name: String, _ values: (USDValue) -> [Value]?
    ) -> USDPrimvar<Value>? {
      USDPrimvar(
        prim.property(name), indices: prim.property(name + ":indices"),
        on: .init(points: domain.points, faces: domain.faces, corners: domain.corners),
        values: values)
    }
    func vectors(_ value: USDValue) -> [SIMD3<Float>]? {
      if case .float3Array(let vectors) = value { vectors } else { nil }
    }
    normals = primvar("primvars:normals", vectors) ?? primvar("normals", vectors)
    coordinates = primvar("primvars:" + appearance.coordinates) {
      if case .float2Array(let vectors) = $0 { vectors } else { nil }
    }
    guard appearance.usesVertexColors else { return }
    colors = primvar("primvars:displayColor") {
      vectors($0)?.map { LinearColor($0).bytes }
    }
  }
}
