/// The pairs of views that see the same triangles: of thousands of views, a small share of all.
///
/// A bit for each pair of views and a count for every 64 of them find a pair's index at once.
struct ViewPairs: Sendable {
  let viewCount: Int
  /// The number of pairs.
  private(set) var count = 0
  private let wordsPerView: Int
  private var bits: [UInt64]
  /// The number of pairs before those of each word.
  private var before: [Int32]

  /// The entries of a triangle are in the order of the views.
  init(of faces: StrideTo<Int>, in views: FaceViews, viewCount: Int) {
    self.viewCount = viewCount
    wordsPerView = (viewCount + 63) / 64
    bits = Array(repeating: 0, count: viewCount * wordsPerView)
    before = Array(repeating: 0, count: bits.count)
    for face in faces {
      let entries = views.entries(of: face)
      for (index, b) in zip(entries.indices, entries) {
        for a in entries[..<index] {
          let (word, bit) = position(Int(b.view), Int(a.view))
          bits[word] |= bit
        }
      }
    }
    for word in bits.indices {
      before[word] = Int32(count)
      count += bits[word].nonzeroBitCount
    }
  }

  /// The index of a pair of views that see the same triangle, the one with the larger number first.
  /// Indices increase with the first view, then with the other.
  func index(of b: Int, _ a: Int) -> Int {
    let (word, bit) = position(b, a)
    return Int(before[word]) + (bits[word] & (bit - 1)).nonzeroBitCount
  }

  /// The views with smaller numbers that form pairs with a view, in their order.
  func partners(of b: Int) -> [Int] {
    (0..<b).filter {
      let (word, bit) = position(b, $0)
      return bits[word] & bit != 0
    }
  }

  private func position(_ b: Int, _ a: Int) -> (word: Int, bit: UInt64) {
    (b * wordsPerView + a >> 6, 1 << UInt64(a & 63))
  }
}
