import SceneModel

/// A solid as a signed distance, negative inside, from which shapes are built by union and
/// difference (Hart, "Sphere tracing", 1996). Where solids are joined it is only a bound of the
/// distance.
struct Solid: Sendable {
  let distance: @Sendable (SIMD3<Float>) -> Float

  init(_ distance: @escaping @Sendable (SIMD3<Float>) -> Float) { self.distance = distance }

  // MARK: Primitives

  /// The hull of two balls, as far as neither contains the other.
  static func cone(
    from a: SIMD3<Float>, to b: SIMD3<Float>, radii: SIMD2<Float>
  ) -> Solid {
    let axis = b - a
    let length = max(axis.length, 1e-6)
    let direction = axis / length
    let slope = min(max((radii.x - radii.y) / length, -1), 1)
    let rise = (1 - slope * slope).squareRoot()
    return Solid { p in
      let along = (p - a).dot(direction)
      let across = max(0, (p - a).squaredLength - along * along).squareRoot()
      let t = along * rise - across * slope
      if t <= 0 { return (p - a).length - radii.x }
      if t >= length * rise { return (p - b).length - radii.y }
      return across * rise + along * slope - radii.x
    }
  }

  static func rod(from a: SIMD3<Float>, to b: SIMD3<Float>, radius: Float) -> Solid {
    cone(from: a, to: b, radii: SIMD2(repeating: radius))
  }

  static func ball(_ center: SIMD3<Float>, _ radius: Float) -> Solid {
    Solid { ($0 - center).length - radius }
  }

  static func ellipsoid(_ center: SIMD3<Float>, _ halfAxes: SIMD3<Float>) -> Solid {
    Solid { p in
      let scaled = (p - center) / halfAxes
      let outside = scaled.length
      let slope = (scaled / halfAxes).length
      return slope > 1e-6 ? outside * (outside - 1) / slope : -halfAxes.min()
    }
  }

  /// A box with edges of the given radius.
  static func box(
    _ center: SIMD3<Float>, _ halfSize: SIMD3<Float>, rounding: Float = 0
  ) -> Solid {
    Solid { p in
      let q = absolute(p - center) - (halfSize - rounding)
      return pointwiseMax(q, .zero).length + min(q.max(), 0) - rounding
    }
  }

  /// A cylinder along one of the axes, 0 to 2, with edges of the given radius.
  static func cylinder(
    _ center: SIMD3<Float>, axis: Int, radius: Float, halfHeight: Float, rounding: Float = 0
  ) -> Solid {
    Solid { p in
      var offset = p - center
      let along = abs(offset[axis]) - (halfHeight - rounding)
      offset[axis] = 0
      let q = SIMD2(offset.length - (radius - rounding), along)
      return pointwiseMax(q, .zero).length + min(q.max(), 0) - rounding
    }
  }

  /// A ring around an axis of unit length.
  static func torus(
    _ center: SIMD3<Float>, axis: SIMD3<Float>, radius: Float, thickness: Float
  ) -> Solid {
    Solid { p in
      let along = (p - center).dot(axis)
      let across = (p - center - axis * along).length
      return SIMD2(across - radius, along).length - thickness
    }
  }

  /// The half space below a plane with a normal of unit length.
  static func below(_ point: SIMD3<Float>, normal: SIMD3<Float>) -> Solid {
    Solid { ($0 - point).dot(normal) }
  }

  // MARK: Combinations

  /// The union, with concave edges rounded over about `rounding`.
  static func union(_ solids: [Solid], rounding: Float = 0) -> Solid {
    Solid { p in
      solids.reduce(Float.infinity) { smoothMinimum($0, $1.distance(p), rounding) }
    }
  }

  func union(_ other: Solid, rounding: Float = 0) -> Solid {
    Solid { p in Self.smoothMinimum(distance(p), other.distance(p), rounding) }
  }

  func intersection(_ other: Solid, rounding: Float = 0) -> Solid {
    Solid { p in -Self.smoothMinimum(-distance(p), -other.distance(p), rounding) }
  }

  func subtracting(_ other: Solid, rounding: Float = 0) -> Solid {
    Solid { p in -Self.smoothMinimum(-distance(p), other.distance(p), rounding) }
  }

  /// The solid with its surface moved outward.
  func displaced(by height: @escaping @Sendable (SIMD3<Float>) -> Float) -> Solid {
    Solid { p in distance(p) - height(p) }
  }

  /// The solid moved by a rigid transform.
  func moved(by transform: RigidTransform) -> Solid {
    let inverse = transform.inverse
    let m = inverse.rotation.matrix
    let rows = [m.row0, m.row1, m.row2].map { SIMD3<Float>($0) }
    let (x, y, z) = (rows[0], rows[1], rows[2])
    let offset = SIMD3<Float>(inverse.translation)
    return Solid { p in distance(SIMD3(x.dot(p), y.dot(p), z.dot(p)) + offset) }
  }

  /// Together with its mirror image on the other side of x = 0.
  var mirrored: Solid { Solid { p in distance(SIMD3(abs(p.x), p.y, p.z)) } }

  /// The unit vector away from the surface.
  func normal(at p: SIMD3<Float>, step: Float) -> SIMD3<Float> {
    SIMD3(
      distance(p + SIMD3(step, 0, 0)) - distance(p - SIMD3(step, 0, 0)),
      distance(p + SIMD3(0, step, 0)) - distance(p - SIMD3(0, step, 0)),
      distance(p + SIMD3(0, 0, step)) - distance(p - SIMD3(0, 0, step))
    ).normalized
  }

  /// The minimum with a continuous derivative where the values differ by less than `width`.
  static func smoothMinimum(_ a: Float, _ b: Float, _ width: Float) -> Float {
    let overlap = max(width - abs(a - b), 0)
    return overlap > 0 ? min(a, b) - overlap * overlap / (4 * width) : min(a, b)
  }

  private static func absolute(_ v: SIMD3<Float>) -> SIMD3<Float> { pointwiseMax(v, -v) }
}
