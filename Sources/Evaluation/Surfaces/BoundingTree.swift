import SceneModel

/// A bounding volume hierarchy over points or triangles for nearest-neighbor and ray queries.
///
/// Items are sorted along the Morton curve of their centers and bisected recursively. The tree is
/// implicit: the children of node i are 2i + 1 and 2i + 2.
struct BoundingTree<Item: BoundedItem>: Sendable {
  private struct Box {
    var min: SIMD3<Float>
    var max: SIMD3<Float>

    func squaredDistance(to point: SIMD3<Float>) -> Float {
      (point - pointwiseMin(pointwiseMax(point, min), max)).squaredLength
    }

    /// Whether the ray intersects the box before `limit`; `inverse` is 1 / direction.
    func isHit(from origin: SIMD3<Float>, _ inverse: SIMD3<Float>, _ limit: Float) -> Bool {
      let (a, b) = ((min - origin) * inverse, (max - origin) * inverse)
      let (near, far) = (pointwiseMin(a, b), pointwiseMax(a, b))
      return Swift.max(near.max(), 0) <= Swift.min(far.min(), limit)
    }
  }

  /// The traversal stack of a query, reusable between queries.
  struct Stack {
    fileprivate var entries: [(node: Int, distance: Float)] = []

    init() {}
  }

  /// Maximum number of items in a leaf. Chosen.
  private static var leafSize: Int { 4 }

  private var items: [Item] = []
  private var boxes: [Box] = []
  /// Index of the first leaf node; leaf k holds the items of `leafRange(k)`.
  private var firstLeaf = 0
  private var leafCount = 1

  init(_ unsorted: [Item]) {
    items = Self.sorted(unsorted)
    while leafCount * Self.leafSize < items.count { leafCount *= 2 }
    firstLeaf = leafCount - 1
    let empty = Box(min: .init(repeating: .infinity), max: .init(repeating: -.infinity))
    boxes = [Box](repeating: empty, count: 2 * leafCount - 1)
    for leaf in 0..<leafCount {
      for item in leafRange(leaf) {
        let bounds = items[item].bounds
        let node = firstLeaf + leaf
        boxes[node].min = pointwiseMin(boxes[node].min, bounds.min)
        boxes[node].max = pointwiseMax(boxes[node].max, bounds.max)
      }
    }
    for node in (0..<firstLeaf).reversed() {
      let (left, right) = (boxes[2 * node + 1], boxes[2 * node + 2])
      boxes[node] = Box(
        min: pointwiseMin(left.min, right.min), max: pointwiseMax(left.max, right.max))
    }
  }

  private func leafRange(_ leaf: Int) -> Range<Int> {
    (leaf * items.count / leafCount)..<((leaf + 1) * items.count / leafCount)
  }

  /// Sorts items along the Morton curve of their centers.
  private static func sorted(_ items: [Item]) -> [Item] {
    let centers = items.map { ($0.bounds.min + $0.bounds.max) / 2 }
    guard let first = centers.first else { return [] }
    let low = centers.reduce(first, pointwiseMin)
    let extent = max((centers.reduce(first, pointwiseMax) - low).max(), .leastNormalMagnitude)
    // Three coordinates of 21 bits each. The extent of a surface from a file may be infinite.
    let last = Float((1 << 21) - 1)
    func number(_ cell: Float) -> UInt64 { cell >= 0 ? spread(UInt64(min(cell, last))) : 0 }
    let keys = centers.map { center -> UInt64 in
      let cell = (center - low) / extent * last
      return number(cell.x) | number(cell.y) << 1 | number(cell.z) << 2
    }
    return keys.indices.sorted { (keys[$0], $0) < (keys[$1], $1) }.map { items[$0] }
  }

  /// Inserts two zero bits after each of the lowest 21 bits.
  private static func spread(_ value: UInt64) -> UInt64 {
    var x = value & 0x1F_FFFF
    x = (x | x << 32) & 0x001F_0000_0000_FFFF
    x = (x | x << 16) & 0x001F_0000_FF00_00FF
    x = (x | x << 8) & 0x100F_00F0_0F00_F00F
    x = (x | x << 4) & 0x10C3_0C30_C30C_30C3
    return (x | x << 2) & 0x1249_2492_4924_9249
  }

  /// The distance to the nearest item, at most `limit`.
  func distance(to point: SIMD3<Float>, limit: Float, _ stack: inout Stack) -> Float {
    nearest(to: point, limit: limit, &stack)?.distance ?? limit
  }

  /// The nearest item that is closer than `limit`, and its distance.
  func nearest(
    to point: SIMD3<Float>, limit: Float, _ stack: inout Stack
  ) -> (item: Item, distance: Float)? {
    var best = limit * limit
    var found: Int?
    stack.entries.removeAll(keepingCapacity: true)
    stack.entries.append((0, boxes[0].squaredDistance(to: point)))
    while let (node, distance) = stack.entries.popLast() {
      guard distance < best else { continue }
      if node >= firstLeaf {
        for item in leafRange(node - firstLeaf) {
          let distance = items[item].squaredDistance(to: point)
          if distance < best { (best, found) = (distance, item) }
        }
        continue
      }
      let (left, right) = (2 * node + 1, 2 * node + 2)
      let leftDistance = boxes[left].squaredDistance(to: point)
      let rightDistance = boxes[right].squaredDistance(to: point)
      if leftDistance < rightDistance {
        stack.entries.append((right, rightDistance))
        stack.entries.append((left, leftDistance))
      } else {
        stack.entries.append((left, leftDistance))
        stack.entries.append((right, rightDistance))
      }
    }
    return found.map { (items[$0], best.squareRoot()) }
  }

  /// Whether `body` is true for any item in a leaf that the ray intersects before `limit`.
  func anyItem(
    from origin: SIMD3<Float>, direction: SIMD3<Float>, limit: Float, _ stack: inout Stack,
    _ body: (Item) -> Bool
  ) -> Bool {
    let inverse = 1 / direction
    stack.entries.removeAll(keepingCapacity: true)
    stack.entries.append((0, 0))
    while let (node, _) = stack.entries.popLast() {
      guard boxes[node].isHit(from: origin, inverse, limit) else { continue }
      if node >= firstLeaf {
        for item in leafRange(node - firstLeaf) where body(items[item]) { return true }
      } else {
        stack.entries.append((2 * node + 2, 0))
        stack.entries.append((2 * node + 1, 0))
      }
    }
    return false
  }
}
