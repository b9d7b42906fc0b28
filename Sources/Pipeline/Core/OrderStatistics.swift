import SceneModel

/// Medians and quantiles.
extension PointCloud {
  /// The median of the positive, finite footprints; nil if there are none.
  var medianFootprint: Float? { footprints.filter { $0 > 0 && $0.isFinite }.upperMedian }
}

extension Array where Element: Comparable {
  /// The median; of an even number of elements, the larger of the middle two. Nil for an empty
  /// array.
  var upperMedian: Element? { quantile(0.5) }

  /// The element that is greater than the fraction `q` of the others; nil for an empty array.
  func quantile(_ q: Double) -> Element? {
    guard !isEmpty else { return nil }
    return sorted()[Swift.min(count - 1, Swift.max(0, Int(q * Double(count))))]
  }

  /// Sorts the elements, and returns the upper median; nil for an empty array. Unlike `upperMedian`
  /// it allocates nothing for few elements.
  mutating func sortedUpperMedian() -> Element? {
    guard !isEmpty else { return nil }
    sort()
    return self[count / 2]
  }
}

extension Array where Element == UInt8 {
  /// The element that is greater than the fraction `q` of the others, such as of the pixels of an
  /// image, which are counted instead of sorted; nil for an empty array.
  func quantile(_ q: Double) -> UInt8? {
    guard !isEmpty else { return nil }
    var counts = [Int](repeating: 0, count: 256)
    for value in self { counts[Int(value)] += 1 }
    var remaining = Swift.min(count - 1, Swift.max(0, Int(q * Double(count))))
    return counts.indices.first { value in
      remaining -= counts[value]
      return remaining < 0
    }
    .map(UInt8.init)
  }
}
