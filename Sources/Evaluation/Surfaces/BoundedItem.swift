/// An item of a `BoundingTree`.
protocol BoundedItem: Sendable {
  /// The axis-aligned bounding box.
  var bounds: (min: SIMD3<Float>, max: SIMD3<Float>) { get }
  /// The point of the item that is nearest to `point`.
  func closestPoint(to point: SIMD3<Float>) -> SIMD3<Float>
  /// The squared distance of that point.
  func squaredDistance(to point: SIMD3<Float>) -> Float
}

extension SIMD3<Float>: BoundedItem {
  var bounds: (min: SIMD3<Float>, max: SIMD3<Float>) { (self, self) }

  func closestPoint(to point: SIMD3<Float>) -> SIMD3<Float> { self }

  func squaredDistance(to point: SIMD3<Float>) -> Float { (self - point).squaredLength }
}
