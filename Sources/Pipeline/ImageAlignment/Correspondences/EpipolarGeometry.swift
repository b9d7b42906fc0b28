import SceneModel

extension RigidTransform {
  /// The essential matrix E of `bFromA`: `x_bᵀ E x_a = 0` for corresponding viewing rays.
  var essentialMatrix: Matrix3 {
    let t = translation
    let cross = Matrix3(rows: [0, -t.z, t.y], [t.z, 0, -t.x], [-t.y, t.x, 0])
    return cross * rotation.matrix
  }
}

extension Matrix3 {
  /// The Sampson distance of two points at depth 1 from this essential matrix: to first order, the
  /// distance that they would have to move to satisfy it.
  func sampsonError(_ first: SIMD2<Double>, _ second: SIMD2<Double>) -> Double {
    let (a, b) = (SIMD3(first, 1), SIMD3(second, 1))
    let line = SIMD3(row0.dot(a), row1.dot(a), row2.dot(a))
    let x = row0.x * b.x + row1.x * b.y + row2.x * b.z
    let y = row0.y * b.x + row1.y * b.y + row2.y * b.z
    let square = line.x * line.x + line.y * line.y + x * x + y * y
    return square > 0 ? abs(b.dot(line)) / square.squareRoot() : .infinity
  }
}
