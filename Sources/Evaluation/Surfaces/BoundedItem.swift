/// An item of a `BoundingTree`.
protocol BoundedItem: Sendable {
  /// The axis-aligned bounding box.
  var bounds: (min: SIMD3<Float>, max: SIMD3<Float>) { get }
  /// The squared distance of the nearest point of the item.
  func squaredDistance(to point: SIMD3<Float>) -> Float
}

extension SIMD3<Float>: BoundedItem {
  var bounds: (min: SIMD3<Float>, max: SIMD3<Float>) { (self, self) }

  func squaredDistance(to point: SIMD3<Float>) -> Float { (self - point).squaredLength }
}
