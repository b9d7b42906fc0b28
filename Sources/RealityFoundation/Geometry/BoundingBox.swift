/// An axis-aligned box.
@frozen public struct BoundingBox: Hashable, Codable, Sendable {
  /// The corner with the smallest coordinates.
  public var min: SIMD3<Float>
  /// The corner with the largest coordinates.
  public var max: SIMD3<Float>

  /// A box that contains no point.
  public static let empty = BoundingBox(
    min: SIMD3(repeating: .infinity), max: SIMD3(repeating: -.infinity))

  /// Creates an empty box.
  public init() { self = .empty }

  /// Creates a box from two opposite corners.
  public init(min: SIMD3<Float>, max: SIMD3<Float>) {
    self.min = min
    self.max = max
  }

  /// Whether the box contains nothing.
  public var isEmpty: Bool { any(min .> max) }

  /// The center; the origin for an empty box.
  public var center: SIMD3<Float> { isEmpty ? .zero : (min + max) * 0.5 }

  /// The edge lengths; zero for an empty box.
  public var extents: SIMD3<Float> { isEmpty ? .zero : max - min }

  /// The radius of the circumscribed sphere; zero for an empty box.
  public var boundingRadius: Float { length(extents) / 2 }
}

extension BoundingBox {
  /// The smallest box that contains this one and the point.
  public func union(_ point: SIMD3<Float>) -> BoundingBox {
    BoundingBox(min: pointwiseMin(min, point), max: pointwiseMax(max, point))
  }

  /// The smallest box that contains both.
  public func union(_ other: BoundingBox) -> BoundingBox {
    BoundingBox(min: pointwiseMin(min, other.min), max: pointwiseMax(max, other.max))
  }

  /// Extends the box to contain the point.
  public mutating func formUnion(_ point: SIMD3<Float>) { self = union(point) }

  /// Extends the box to contain the other one.
  public mutating func formUnion(_ other: BoundingBox) { self = union(other) }

  /// Whether the point is inside or on the boundary.
  public func contains(_ point: SIMD3<Float>) -> Bool {
    all(min .<= point) && all(point .<= max)
  }

  /// Whether the other box is inside; an empty one is inside every box.
  public func contains(_ other: BoundingBox) -> Bool {
    other.isEmpty || (contains(other.min) && contains(other.max))
  }

  /// Whether the boxes have a point in common.
  public func intersects(_ other: BoundingBox) -> Bool {
    all(min .<= other.max) && all(other.min .<= max) && !isEmpty && !other.isEmpty
  }

  /// The squared distance to the point: zero inside, infinite for an empty box.
  public func distanceSquared(toPoint point: SIMD3<Float>) -> Float {
    isEmpty
      ? .infinity : length_squared(point - point.clamped(lowerBound: min, upperBound: max))
  }

  /// Replaces the box by the axis-aligned box around its transformed corners.
  public mutating func transform(by matrix: float4x4) { self = transformed(by: matrix) }

  /// The axis-aligned box around the transformed corners.
  public func transformed(by matrix: float4x4) -> BoundingBox {
    guard !isEmpty else { return self }
    return (0..<8).reduce(into: BoundingBox.empty) { box, corner in
      let point = SIMD4(
        corner & 1 == 0 ? min.x : max.x, corner & 2 == 0 ? min.y : max.y,
        corner & 4 == 0 ? min.z : max.z, 1)
      let image = matrix * point
      box.formUnion(SIMD3(image.x, image.y, image.z))
    }
  }
}
