import Kernels
import SceneModel

/// Divides photos in the order of capture into intervals, between which the object was moved.
///
/// For each number of intervals, dynamic programming finds the division with the highest sum of
/// affinities within them.
struct CaptureIntervals {
  struct Options: Hashable, Codable, Sendable {
    /// Minimum number of photos of a placement. Chosen: a side of an object is hardly shown by
    /// fewer.
    var minimumPhotos = 5
    /// Maximum number of intervals. Chosen: a box has six sides to lie on.
    var maximumIntervals = 8
    /// Maximum affinity of a single pair, for or against intervals, in points or matches: a photo
    /// with a wrong pose strongly contradicts a few others. It is also what a boundary between two
    /// intervals costs: a single pair, however strong, justifies none. Chosen.
    var maximumAffinity = 100
    /// Maximum share of the photos that contradict their own interval and agree with another one.
    /// Chosen: they may have wrong poses.
    var maximumMisassignedShare = 0.05
    /// Intervals are placements if, in the median of the photos, at most this share of a photo's
    /// negative affinity remains within its own interval, relative to what would remain by chance.
    /// Chosen.
    var maximumRemainder = 0.5

    /// Minimum number of photos on each side of a boundary that contradict the other side: most of
    /// those of the smallest placement.
    var minimumBoundarySupport: Int { minimumPhotos / 2 + 1 }

    init() {}
  }

  private let options: Options
  private let photoCount: Int
  /// The affinities of each photo: positive for others that show the object in the same placement,
  /// negative for those that show it in another one.
  private let affinities: [[(photo: Int, value: Int)]]

  /// An affinity is positive if both photos of a pair show the object in the same placement,
  /// negative if they show it in different ones.
  init(_ affinities: [PhotoPair: Int], photoCount: Int, options: Options = Options()) {
    (self.options, self.photoCount) = (options, photoCount)
    var byPhoto = [[(photo: Int, value: Int)]](repeating: [], count: photoCount)
    for (pair, value) in affinities where value != 0 {
      byPhoto[pair.first.index].append((pair.second.index, value))
      byPhoto[pair.second.index].append((pair.first.index, value))
    }
    self.affinities = byPhoto
  }

  /// The division into the fewest intervals that explains the affinities; nil if none does.
  func division(_ control: KernelControl = KernelControl()) throws -> [[Int]]? {
    // Without negative affinities, a boundary explains nothing.
    guard affinities.contains(where: { $0.contains { $0.value < 0 } }) else { return nil }
    let divisions = try divisions(control)
    guard let undivided = divisions.first else { return nil }
    return divisions.dropFirst().first {
      $0.score > undivided.score && isExplained(by: $0.groups) && areBoundariesSupported($0.groups)
        && areWellAssigned($0.groups)
    }.map { centered($0.groups) }
  }

  /// The division with each boundary in the middle of the positions that explain the affinities
  /// equally well.
  private func centered(_ groups: [[Int]]) -> [[Int]] {
    var starts = groups.map { $0[0] } + [photoCount]
    for index in starts.indices.dropFirst().dropLast() {
      let (start, end) = (starts[index - 1], starts[index + 1])
      let range = start + options.minimumPhotos...end - options.minimumPhotos
      var (first, last) = (starts[index], starts[index])
      while first > range.lowerBound, balance(first - 1, start..<end) == 0 { first -= 1 }
      while last < range.upperBound, balance(last, start..<end) == 0 { last += 1 }
      starts[index] = (first + last + 1) / 2
    }
    return zip(starts, starts.dropFirst()).map { Array($0..<$1) }
  }

  /// How much the affinity between the two sides of a boundary changes if a photo next to it
  /// changes sides: its affinity with the photos of a range before it, minus that with those after
  /// it.
  private func balance(_ photo: Int, _ range: Range<Int>) -> Int {
    affinities[photo].reduce(0) { sum, other in
      guard range.contains(other.photo) else { return sum }
      return sum + (other.photo < photo ? 1 : -1) * clamped(other.value)
    }
  }

  private func clamped(_ value: Int) -> Int {
    min(options.maximumAffinity, max(-options.maximumAffinity, value))
  }

  /// The best division for each number of intervals, in O(n²) for n photos.
  private func divisions(_ control: KernelControl) throws -> [(groups: [[Int]], score: Int)] {
    let most = min(options.maximumIntervals, photoCount / options.minimumPhotos)
    guard most > 0 else { return [] }
    // By the number of intervals and their end: the score, and the start of the last one.
    let row = [Int](repeating: .min, count: photoCount + 1)
    var scores = [[Int]](repeating: row, count: most + 1)
    var starts = scores
    scores[0][0] = options.maximumAffinity
    // The affinities within `first..<end`, by `first`.
    var within = [Int](repeating: 0, count: photoCount)
    for end in stride(from: 1, through: photoCount, by: 1) {
      try control.checkCancellation()
      add(end - 1, to: &within)
      let last = end - options.minimumPhotos
      guard last >= 0 else { continue }
      for count in 1...most {
        var (best, start) = (Int.min, Int.min)
        for first in stride(from: last, through: 0, by: -1) where scores[count - 1][first] != .min {
          let score = scores[count - 1][first] + within[first]
          if score > best { (best, start) = (score, first) }
        }
        guard start != .min else { continue }
        (scores[count][end], starts[count][end]) = (best - options.maximumAffinity, start)
      }
    }
    return (1...most).compactMap { count in
      let score = scores[count][photoCount]
      guard score != .min else { return nil }
      var (groups, end) = ([[Int]](), photoCount)
      for count in stride(from: count, to: 0, by: -1) {
        let start = starts[count][end]
        groups.append(Array(start..<end))
        end = start
      }
      return (groups.reversed(), score)
    }
  }

  /// Adds the affinities between a photo and those before it to the sums from each first photo on.
  private func add(_ photo: Int, to within: inout [Int]) {
    let before = affinities[photo].filter { $0.photo < photo }.sorted { $0.photo > $1.photo }
    var sum = 0
    for (index, other) in before.enumerated() {
      sum += clamped(other.value)
      let next = index + 1 < before.count ? before[index + 1].photo : -1
      for first in stride(from: other.photo, to: next, by: -1) { within[first] += sum }
    }
  }

  /// Whether little of the negative affinity of most photos remains within their own interval.
  private func isExplained(by groups: [[Int]]) -> Bool {
    let remainders = groups.flatMap { group in
      group.compactMap { photo -> Double? in
        let against = affinities[photo].filter { $0.value < 0 }
        guard !against.isEmpty else { return nil }
        func sum(_ part: [(photo: Int, value: Int)]) -> Int { part.reduce(0) { $0 + $1.value } }
        let within = against.filter { group[0]...group[group.count - 1] ~= $0.photo }
        return Double(sum(within)) / Double(sum(against))
      }
    }
    let byChance = 1 / Double(groups.count)
    return (remainders.upperMedian ?? 0) <= options.maximumRemainder * byChance
  }

  /// Whether several photos contradict the other side of each boundary.
  private func areBoundariesSupported(_ groups: [[Int]]) -> Bool {
    zip(groups, groups.dropFirst()).allSatisfy { left, right in
      min(
        left.count { sum($0, with: right) < 0 }, right.count { sum($0, with: left) < 0 }
      ) >= options.minimumBoundarySupport
    }
  }

  /// Whether hardly any photo is assigned to an interval that it contradicts, while it agrees with
  /// another.
  private func areWellAssigned(_ groups: [[Int]]) -> Bool {
    let misassigned = groups.reduce(0) { count, group in
      count
        + group.count { photo in
          sum(photo, with: group) < 0 && groups.contains { sum(photo, with: $0) > 0 }
        }
    }
    return Double(misassigned) <= options.maximumMisassignedShare * Double(photoCount)
  }

  /// The sum of the affinities between a photo and those of an interval.
  private func sum(_ photo: Int, with group: [Int]) -> Int {
    affinities[photo].reduce(0) {
      group[0]...group[group.count - 1] ~= $1.photo ? $0 + $1.value : $0
    }
  }
}
