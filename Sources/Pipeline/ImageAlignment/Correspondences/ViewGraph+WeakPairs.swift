import SceneModel

extension ViewGraph {
  /// The weak pairs of photos that have few verified partners: where a photo would be left out, a
  /// few matches that agree are better than none. Photos with more partners are registered without
  /// them.
  func weakPairs(ofPhotosWithFewerPartnersThan minimumPartners: Int) -> [VerifiedPair] {
    let counts = partners.map(\.count)
    return rejected.compactMap(\.weak).filter {
      min(counts[$0.pair.first.index], counts[$0.pair.second.index]) < minimumPartners
    }
  }

  /// Adds pairs that were rejected so far.
  mutating func add(_ accepted: [VerifiedPair]) {
    let isAccepted = Set(accepted.map(\.pair))
    rejected.removeAll { isAccepted.contains($0.pair) }
    pairs = (pairs + accepted).sorted { $0.pair < $1.pair }
  }
}
