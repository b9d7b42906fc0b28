import SceneModel

extension ViewGraph {
  /// The weak pairs of photos that have few verified partners: where a photo would be left out, a
  /// few matches that agree are better than none. Photos with more partners are registered without
  /// them.
  func weakPairs(ofPhotosWithFewerPartnersThan minimumPartners: Int) -> [VerifiedPair] {
    var partners = [Int](repeating: 0, count: photoCount)
    for pair in pairs {
      partners[pair.pair.first.index] += 1
      partners[pair.pair.second.index] += 1
    }
    return rejected.compactMap(\.weak).filter {
      min(partners[$0.pair.first.index], partners[$0.pair.second.index]) < minimumPartners
    }
  }

  /// Adds pairs that were rejected so far.
  mutating func add(_ accepted: [VerifiedPair]) {
    let isAccepted = Set(accepted.map(\.pair))
    rejected.removeAll { isAccepted.contains($0.pair) }
    pairs = (pairs + accepted).sorted { $0.pair < $1.pair }
  }
}
