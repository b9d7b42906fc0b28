import Foundation
import SceneModel

/// The matches of consecutive pairs, which one process makes for others.
struct MatchBlock: Equatable, Sendable {
  /// Pairs per block: their photos are few, since pairs are sorted, and their features fit into the
  /// memory. Chosen.
  static let pairCount = 500

  var matches: [[FeatureMatch]]

  /// The blocks of some pairs, as ranges of indices.
  static func ranges(of pairs: [PhotoPair]) -> [Range<Int>] {
    stride(from: 0, to: pairs.count, by: pairCount).map {
      $0..<min($0 + pairCount, pairs.count)
    }
  }
}

extension MatchBlock: UnitValue {
  /// The number of pairs, the number of matches of each, and the matches, as 32-bit integers in
  /// native byte order.
  func unitData() throws -> Data {
    var data = Data()
    func append(_ values: [Int32]) {
      values.withUnsafeBytes { data.append(contentsOf: $0) }
    }
    append([Int32(matches.count)])
    append(matches.map { Int32($0.count) })
    for pair in matches { append(pair.flatMap { [$0.first, $0.second] }) }
    return data
  }

  init?(unit: Data) {
    let bytes = [UInt8](unit)
    guard bytes.count >= 4, bytes.count % 4 == 0 else { return nil }
    let words = bytes.withUnsafeBytes { bytes in
      var reader = ArrayReader(bytes: bytes, offset: 0)
      return reader.array(bytes.count / 4, of: Int32.self)
    }
    let pairs = Int(words[0])
    guard pairs >= 0, pairs < words.count else { return nil }
    let counts = words[1..<(1 + pairs)].map { Int($0) }
    guard counts.allSatisfy({ $0 >= 0 }), counts.reduce(0, +) * 2 == words.count - 1 - pairs
    else { return nil }
    var next = 1 + pairs
    matches = counts.map { count in
      defer { next += 2 * count }
      return (0..<count).map {
        FeatureMatch(first: words[next + 2 * $0], second: words[next + 2 * $0 + 1])
      }
    }
  }
}
