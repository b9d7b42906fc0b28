import Kernels
import SceneModel

/// From features to verified pairs: pair selection, matching, verification, and self-calibration of
/// cameras without metadata.
package struct CorrespondenceSearch {
  package struct Options: Hashable, Codable, Sendable {
    package var selection = PairSelection.Options()
    package var matching = FeatureMatching.Options()
    package var verification = PairVerification.Options()
    package var selfCalibration = SelfCalibration.Options()

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The verified pairs, and the cameras with a better first focal length where only an assumption was
  /// known and the matches tell more.
  package func run(
    photos: [Photo], cameras: [Camera], features: [FeatureSet], isSequential: Bool,
    _ context: StageContext
  ) throws -> (viewGraph: ViewGraph, cameras: [Camera]) {
    let pairs = try PairSelection(options.selection)
      .run(features, isSequential: isSequential, context.part(from: 0, to: 0.2))
    let matches = try FeatureMatching(options.matching)
      .run(pairs, features: features, context.part(from: 0.2, to: 0.8))
    func verified(_ cameras: [Camera], _ options: PairVerification.Options, _ context: StageContext)
      throws -> ViewGraph
    {
      try PairVerification(options)
        .run(
          pairs, matches: matches, features: features, photos: photos, cameras: cameras, context)
    }
    var graph = try verified(cameras, options.verification, context.part(from: 0.8, to: 0.9))
    let calibrated = try SelfCalibration(options.selfCalibration)
      .run(
        graph, features: features, photos: photos, cameras: cameras,
        context.part(from: 0.9, to: 0.95))
    if calibrated != cameras {
      // Known well enough now for essential matrices.
      var verification = options.verification
      verification.isUncalibratedWhereAssumed = false
      graph = try verified(calibrated, verification, context.part(from: 0.95, to: 1))
    }
    report(pairs, matches, graph, context.notes)
    return (graph, calibrated)
  }

  private func report(
    _ pairs: [PhotoPair], _ matches: [[FeatureMatch]], _ graph: ViewGraph, _ notes: StageNotes
  ) {
    notes.count("pairs", Double(pairs.count))
    notes.count("matches", Double(matches.reduce(0) { $0 + $1.count }))
    notes.count("verifiedPairs", Double(graph.pairs.count))
    notes.count("verifiedMatches", Double(graph.pairs.reduce(0) { $0 + $1.matches.count }))
    if graph.pairs.isEmpty, graph.photoCount > 1 {
      notes.warn(
        "No two photos show the same surface; take photos that overlap by two thirds.")
    }
  }
}
