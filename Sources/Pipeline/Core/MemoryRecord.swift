/// The resident memory of the process over time.
package struct MemoryRecord: Hashable, Codable, Sendable {
  /// Since the beginning of the run.
  package private(set) var seconds: [Double] = []
  package private(set) var bytes: [Int] = []

  /// Seconds between two samples; doubled whenever the record is full. Chosen: a curve has no finer
  /// detail on the screen.
  private var interval = Self.shortestInterval
  static let shortestInterval = 0.5
  private static let maximumCount = 1200

  private enum CodingKeys: CodingKey { case seconds, bytes }

  package init() {}

  /// Adds a sample, unless the last one is too recent.
  mutating func add(_ sample: Int, at time: Double) {
    if let last = seconds.last, time < last + interval { return }
    seconds.append((time * 100).rounded() / 100)
    bytes.append(sample)
    guard seconds.count > Self.maximumCount else { return }
    interval *= 2
    let kept = seconds.indices.filter { $0.isMultiple(of: 2) }
    (seconds, bytes) = (kept.map { seconds[$0] }, kept.map { bytes[$0] })
  }
}
