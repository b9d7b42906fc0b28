import SceneModel

/// An affine map of a node of a scene, in doubles: `parentFromNode`.
struct NodeTransform: Equatable {
  var linear = Matrix3.identity
  var translation = SIMD3<Double>.zero

  static let identity = NodeTransform()

  static func * (a: NodeTransform, b: NodeTransform) -> NodeTransform {
    NodeTransform(
      linear: a.linear * b.linear, translation: a.linear * b.translation + a.translation)
  }

  static func translation(_ v: SIMD3<Double>) -> NodeTransform { NodeTransform(translation: v) }

  static func scale(_ v: SIMD3<Double>) -> NodeTransform {
    NodeTransform(linear: Matrix3(rows: [v.x, 0, 0], [0, v.y, 0], [0, 0, v.z]))
  }

  static func rotation(_ q: Quaternion) -> NodeTransform {
    NodeTransform(linear: q.normalized.matrix)
  }

  /// The inverse; nil if the map is singular.
  var inverse: NodeTransform? {
    guard let x = linear.solution(of: [1, 0, 0]), let y = linear.solution(of: [0, 1, 0]),
      let z = linear.solution(of: [0, 0, 1])
    else { return nil }
    let inverse = Matrix3(rows: x, y, z).transpose
    return NodeTransform(linear: inverse, translation: -(inverse * translation))
  }

  /// A map from the 16 elements of a 4×4 matrix whose translation is in elements 12 to 14: in
  /// columns for column vectors (glTF), or in rows for row vectors (USD).
  init?(elements m: [Double]) {
    guard m.count == 16 else { return nil }
    linear = Matrix3(rows: [m[0], m[4], m[8]], [m[1], m[5], m[9]], [m[2], m[6], m[10]])
    translation = [m[12], m[13], m[14]]
  }

  init(linear: Matrix3 = .identity, translation: SIMD3<Double> = .zero) {
    (self.linear, self.translation) = (linear, translation)
  }

  /// Maps a part. Triangles stay counterclockwise under a reflection.
  func applied(to part: LoadedModel.Part) -> LoadedModel.Part {
    guard self != .identity else { return part }
    var result = part
    result.positions = part.positions.map {
      SIMD3<Float>(linear * SIMD3<Double>($0) + translation)
    }
    let columns = linear.transpose
    let (x, y, z) = (columns.row0, columns.row1, columns.row2)
    let mirrors = linear.determinant < 0
    // The inverse transpose up to scale.
    let cofactors = Matrix3(rows: y.cross(z), z.cross(x), x.cross(y)).transpose
    result.normals = part.normals.map {
      let image = cofactors * SIMD3<Double>($0)
      return SIMD3<Float>((mirrors ? -image : image).normalized)
    }
    if mirrors { result.triangles = part.triangles.map(\.flipped) }
    return result
  }
}
