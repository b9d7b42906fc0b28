import Kernels
import SceneModel

/// Pairs and matches that other processes have made or will need, for the features of some photos.
struct CorrespondenceUnits: Sendable {
  let store: UnitStore
  /// By photo, what its features were made from.
  let featureKeys: [UInt64]
  /// Of the options that pairs depend on besides the features.
  private let selectionKey: UInt64

  init(
    _ store: UnitStore, featureKeys: [UInt64], _ selection: PairSelection.Options,
    ordering: SampleOrdering, positions: [GeographicPosition?]
  ) throws {
    (self.store, self.featureKeys) = (store, featureKeys)
    var key = Fingerprint()
    key.add(try Fingerprint.content(of: selection))
    key.add(ordering.rawValue.utf8)
    key.add(try Fingerprint.content(of: positions))
    featureKeys.forEach { key.add($0) }
    selectionKey = key.value
  }

  /// The choice of pairs.
  func choice(_ make: () throws -> PairSelection.Choice) throws -> PairSelection.Choice {
    try store.value(.pairs, madeFrom: selectionKey, make)
  }

  /// The pairs that are considered.
  func candidates(
    _ make: () throws -> PairSelection.Candidates
  ) throws -> PairSelection.Candidates {
    try store.value(.candidates, madeFrom: selectionKey, make)
  }

  /// Those of a range of the tested candidates that are promising.
  func promising(_ range: Range<Int>, _ make: () throws -> [PhotoPair]) throws -> [PhotoPair] {
    var key = Fingerprint()
    key.add(selectionKey)
    key.add(range.lowerBound)
    key.add(range.upperBound)
    return try store.value(.promising, madeFrom: key.value) { PairList(pairs: try make()) }.pairs
  }

  /// The pairs that follow from the matches of the first ones, by some options of the search.
  func morePairs(
    _ options: some Encodable, cameras: [Camera], photos: [Photo],
    _ make: () throws -> [PhotoPair]
  ) throws -> [PhotoPair] {
    var key = Fingerprint()
    key.add(selectionKey)
    key.add(try Fingerprint.content(of: options))
    key.add(try Fingerprint.content(of: cameras))
    key.add(try Fingerprint.content(of: photos.map(\.camera.index)))
    key.add(try Fingerprint.content(of: photos.map { $0.mask != nil }))
    return try store.value(.morePairs, madeFrom: key.value) { PairList(pairs: try make()) }.pairs
  }

  /// The matches of a block of pairs; `fingerprint` is that of all that they depend on besides the
  /// features.
  func block(
    _ pairs: ArraySlice<PhotoPair>, madeFrom fingerprint: UInt64, _ make: () throws -> MatchBlock
  ) throws -> MatchBlock {
    var key = Fingerprint()
    key.add(fingerprint)
    for pair in pairs {
      for photo in [pair.first, pair.second] {
        key.add(photo.index)
        key.add(featureKeys[photo.index])
      }
    }
    return try store.value(.matches, madeFrom: key.value, make)
  }
}

/// Pairs as one process leaves them for others.
private struct PairList: Codable, UnitValue {
  var pairs: [PhotoPair]
}
