import Kernels
import SceneModel

/// Matches pairs of photos, verifies the matches, and searches for more where they are few.
struct PairMatching {
  let matching: FeatureMatching
  let verification: PairVerification
  let guidedMatching: GuidedMatching
  let photos: [Photo]
  let cameras: [Camera]

  /// The matches of some pairs, as far as they are not among `units` already.
  func run(
    _ pairs: [PhotoPair], features: [FeatureSet], units: CorrespondenceUnits?,
    _ context: StageContext
  ) throws -> MatchBlock {
    guard let units else { return try make(pairs, features: features, context) }
    let key = try fingerprint
    var result = MatchBlock()
    for range in MatchBlock.ranges(of: pairs) {
      let part = context.part(
        from: Double(range.lowerBound) / Double(pairs.count),
        to: Double(range.upperBound) / Double(pairs.count))
      result.append(
        try units.block(pairs[range], madeFrom: key) {
          try make(Array(pairs[range]), features: features, part)
        })
    }
    return result
  }

  /// The matches of some pairs; needs the features of their photos only.
  func make(
    _ pairs: [PhotoPair], features: [FeatureSet], _ context: StageContext
  ) throws -> MatchBlock {
    let matches = try matching.run(pairs, features: features, context.part(from: 0, to: 0.8))
    let verdicts = try verification.verdicts(
      pairs, matches: matches, features: features, photos: photos, cameras: cameras,
      context.part(from: 0.8, to: 0.95))
    let graph = ViewGraph(photoCount: photos.count, verdicts)
    let guided = try guidedMatching.run(
      graph, features: features, photos: photos, cameras: cameras,
      StageContext(control: context.control.part(from: 0.95, to: 1)))
    let better = zip(guided.pairs, graph.pairs).filter { $0.matches.count > $1.matches.count }
    return MatchBlock(matches: matches, verdicts: verdicts, guided: better.map(\.0))
  }

  /// The fingerprint of all that matches depend on besides the features and the pairs.
  var fingerprint: UInt64 {
    get throws {
      var key = Fingerprint()
      key.add(try Fingerprint.content(of: matching.options))
      key.add(try Fingerprint.content(of: verification.options))
      key.add(try Fingerprint.content(of: guidedMatching.options))
      key.add(try Fingerprint.content(of: cameras))
      key.add(try Fingerprint.content(of: photos.map(\.camera.index)))
      return key.value
    }
  }
}
