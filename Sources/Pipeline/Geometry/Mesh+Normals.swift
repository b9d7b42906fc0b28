import Foundation
import SceneModel

extension Mesh {
  /// Unit vertex normals: face normals weighted by their angle at the vertex (Thürmer and Wüthrich,
  /// 1998). Vertices without triangles get +y.
  func angleWeightedNormals() -> [SIMD3<Float>] {
    var sums = [SIMD3<Float>](repeating: .zero, count: positions.count)
    for triangle in triangles {
      let (a, b, c) = corners(of: triangle)
      let normal = (b - a).cross(c - a).normalized
      sums[Int(triangle.a)] += normal * Self.angle(b - a, c - a)
      sums[Int(triangle.b)] += normal * Self.angle(c - b, a - b)
      sums[Int(triangle.c)] += normal * Self.angle(a - c, b - c)
    }
    return sums.map { sum in
      let unit = sum.normalized
      return unit.squaredLength > 0.5 ? unit : [0, 1, 0]
    }
  }

  /// Unit vertex normals: the area-weighted mean of the face normals. Vertices without triangles
  /// get +y.
  func areaWeightedNormals() -> [SIMD3<Float>] {
    var sums = [SIMD3<Double>](repeating: .zero, count: positions.count)
    for triangle in triangles {
      let (a, b, c) = corners(of: triangle)
      let normal = SIMD3<Double>(b - a).cross(SIMD3<Double>(c - a))
      for vertex in [triangle.a, triangle.b, triangle.c] { sums[Int(vertex)] += normal }
    }
    return sums.map { sum in
      let normal = SIMD3<Float>(sum.normalized)
      return normal == .zero ? [0, 1, 0] : normal
    }
  }

  /// The angle between two vectors in radians; 0 if either is zero.
  static func angle(_ u: SIMD3<Float>, _ v: SIMD3<Float>) -> Float {
    atan2(u.cross(v).length, u.dot(v))
  }
}
