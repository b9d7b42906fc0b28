import SceneModel

/// Unit vectors in four bytes, for the filter `OCTAHEDRAL` of `EXT_meshopt_compression`.
///
/// The sphere is projected to an octahedron that is unfolded to a square (Meyer et al., EGSR 2010).
/// With 8 bits the error is at most 0.9°, and 1.2° after the decoder has rounded to bytes again;
/// more bits would need twice the memory, and the baked normal map has the fine relief.
enum OctahedralNormal {
  /// The normalized byte for 1. Limit: the largest signed byte.
  private static let one: Float = 127

  /// The two coordinates in the square, the value of 1, and a zero. The vector (0, 1, 0) replaces
  /// one without a direction: glTF requires unit length.
  static func encode(_ normal: SIMD3<Float>) -> [UInt8] {
    let unit = normal.normalized
    let v = unit.squaredLength > 0.5 ? unit : [0, 1, 0]
    var p = SIMD2(v.x, v.y) / (abs(v.x) + abs(v.y) + abs(v.z))
    if v.z < 0 {
      p = SIMD2((1 - abs(p.y)) * (v.x < 0 ? -1 : 1), (1 - abs(p.x)) * (v.y < 0 ? -1 : 1))
    }
    return [byte(p.x), byte(p.y), UInt8(one), 0]
  }

  private static func byte(_ value: Float) -> UInt8 {
    UInt8(bitPattern: Int8((min(max(value, -1), 1) * one).rounded()))
  }
}
