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
    return element(ofRank: Swift.min(count - 1, Swift.max(0, Int(q * Double(count)))))
  }

  /// The element at an index of the sorted array.
  func element(ofRank rank: Int) -> Element {
    var values = self
    return values.select(rank)
  }

  /// The element of a rank in ascending order, found by partitions (Hoare, "Algorithm 65: find",
  /// CACM 1961). Elements move.
  private mutating func select(_ rank: Int) -> Element {
    var open = indices
    // Each partition by a median of three leaves less than three quarters of random elements; where
    // they keep leaving more, sorting is faster.
    var remaining = 4 * (Int.bitWidth - count.leadingZeroBitCount)
    while open.count > 16, remaining > 0 {  // Chosen: few elements are sorted as fast.
      remaining -= 1
      let pivot = medianOfThree(open)
      let (less, greater) = partition(open, around: pivot)
      if rank < less {
        open = open.lowerBound..<less
      } else if rank >= greater {
        open = greater..<open.upperBound
      } else {
        return pivot
      }
    }
    self[open].sort()
    return self[rank]
  }

  private func medianOfThree(_ range: Range<Int>) -> Element {
    let (a, b, c) = (
      self[range.lowerBound], self[range.lowerBound + range.count / 2], self[range.upperBound - 1]
    )
    return Swift.max(Swift.min(a, b), Swift.min(Swift.max(a, b), c))
  }

  /// Moves lesser elements of a range to its front and greater ones to its end; returns where the
  /// equal ones begin and end.
  private mutating func partition(
    _ range: Range<Int>, around pivot: Element
  ) -> (less: Int, greater: Int) {
    var (less, next, greater) = (range.lowerBound, range.lowerBound, range.upperBound)
    while next < greater {
      if self[next] < pivot {
        swapAt(less, next)
        less += 1
        next += 1
      } else if pivot < self[next] {
        greater -= 1
        swapAt(next, greater)
      } else {
        next += 1
      }
    }
    return (less, greater)
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
