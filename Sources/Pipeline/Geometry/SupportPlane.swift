import SceneModel

/// The plane that supports an object: `normal · x = offset`; the normal points up.
package struct SupportPlane: Hashable, Codable, Sendable {
  var normal: SIMD3<Double>
  var offset: Double
  /// Half the thickness of the slab of points that belong to the support, in world units.
  var band: Double

  /// Signed distance above the plane in world units.
  func height(of point: SIMD3<Double>) -> Double { normal.dot(point) - offset }

  func heights(of points: [SIMD3<Float>]) -> [Float] {
    points.map { Float(height(of: SIMD3<Double>($0))) }
  }
}

extension SupportPlane {
  /// The plane through three points; nil if they are close together (within ten bands) or nearly
  /// collinear (within 3°).
  init?(through points: [SIMD3<Double>], up: SIMD3<Double>, band: Double) {
    let (u, v) = (points[1] - points[0], points[2] - points[0])
    let cross = u.cross(v)
    guard cross.length > 0.05 * u.length * v.length, u.length > 10 * band, v.length > 10 * band
    else { return nil }
    normal = cross.normalized
    if normal.dot(up) < 0 { normal = -normal }
    offset = normal.dot(points[0])
    self.band = band
  }

  /// The least-squares plane in height over `plane`; nil if the points are collinear.
  init?(fitting points: [SIMD3<Double>], near plane: SupportPlane) {
    let (u, v) = plane.normal.orthonormalPair
    let mean = points.reduce(.zero, +) / Double(points.count)
    var matrix = Matrix3(rows: .zero, .zero, .zero)
    var right = SIMD3<Double>.zero
    for point in points {
      let d = point - mean
      let row = SIMD3(d.dot(u), d.dot(v), 1)
      matrix.row0 += row.x * row
      matrix.row1 += row.y * row
      matrix.row2 += row
      right += plane.height(of: point) * row
    }
    guard let slope = matrix.solution(of: right) else { return nil }
    normal = (plane.normal - slope.x * u - slope.y * v).normalized
    offset = normal.dot(mean + (slope.z - plane.height(of: mean)) * plane.normal)
    band = plane.band
  }
}

extension SIMD3 where Scalar == Double {
  /// Two unit vectors that complete this unit vector to a right-handed frame.
  var orthonormalPair: (SIMD3<Double>, SIMD3<Double>) {
    let helper: SIMD3<Double> = abs(x) < 0.6 ? [1, 0, 0] : [0, 0, 1]
    let u = cross(helper).normalized
    return (u, cross(u))
  }
}
