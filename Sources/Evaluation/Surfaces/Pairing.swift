import SceneModel

/// Finds the closest points of two surfaces in both directions.
struct Pairing<Item: BoundedItem>: Sendable {
  /// In the frame of the result.
  let resultTree: BoundingTree<Item>
  let referenceTree: BoundingTree<FlatTriangle>
  let result: [SIMD3<Float>]
  let reference: [SIMD3<Float>]
  /// Points without a counterpart within this distance, in units of the reference, have no pair.
  let limit: Float

  /// The pairs with the result moved by `referenceFromResult`.
  func pairs(_ referenceFromResult: SimilarityTransform) -> [ClosestPair] {
    let resultFromReference = referenceFromResult.inverse
    var pairs: [ClosestPair] = []
    pairs.reserveCapacity(result.count + reference.count)
    var stack = BoundingTree<FlatTriangle>.Stack()
    for point in result {
      let moved = SIMD3<Float>(referenceFromResult * SIMD3<Double>(point))
      guard let (triangle, distance) = referenceTree.nearest(to: moved, limit: limit, &stack)
      else { continue }
      pairs.append(
        ClosestPair(
          source: SIMD3<Double>(point), target: SIMD3<Double>(triangle.closestPoint(to: moved)),
          normal: triangle.normal, distance: distance))
    }
    var resultStack = BoundingTree<Item>.Stack()
    let scale = Float(referenceFromResult.scale)
    for point in reference {
      let moved = SIMD3<Float>(resultFromReference * SIMD3<Double>(point))
      guard
        let (item, distance) = resultTree.nearest(
          to: moved, limit: limit / scale, &resultStack),
        let (triangle, _) = referenceTree.nearest(to: point, limit: limit, &stack)
      else { continue }
      pairs.append(
        ClosestPair(
          source: SIMD3<Double>(item.closestPoint(to: moved)), target: SIMD3<Double>(point),
          normal: triangle.normal, distance: distance * scale))
    }
    return pairs
  }
}
