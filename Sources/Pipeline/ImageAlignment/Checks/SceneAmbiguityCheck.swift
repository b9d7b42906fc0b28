import Kernels
import SceneModel

/// Detects reconstructions that superimpose repeated structures of the scene.
///
/// Two sides of a box, or two bays of a facade, share features as if they were two photos of one
/// side, and the map folds. Two signs reveal this. First, some pairs match the correct parts and
/// others the wrong ones, so that strong pairs contradict the reconstruction. Second, photos with
/// nearly the same estimated pose differ outside the repeated structure: one photo shows points
/// that nothing occludes from the other, yet their texture is missing there (after Zach et al. on
/// missing correspondences, CVPR 2008, and Heinly et al., "Correcting for duplicate scene structure
/// in sparse 3D reconstruction", ECCV 2014). A missing feature alone proves nothing, so the texture
/// itself is searched for.
package struct SceneAmbiguityCheck: Sendable {
  /// The signs that a reconstruction is wrong.
  package struct Findings: Hashable, Sendable {
    /// Number of pairs of nearby photos that show enough of each other's points to be compared.
    package var compared = 0
    /// The pairs in conflict, the strongest conflict first.
    package var conflicts: [Comparison] = []
    /// Pairs whose matches contradict the reconstruction, sorted.
    package var contradicted: [PhotoPair] = []
    /// Groups of photos between which the object seems to have been moved.
    var placements = Placements(groups: [], basis: .none)
    package var verdict = Verdict.consistent
  }

  /// The result of the check.
  package enum Verdict: Hashable, Sendable {
    /// Neither sign is present.
    case consistent
    /// One of the two signs is present.
    case ambiguous
    /// Both signs are present.
    case inconsistent
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Checks a reconstruction; `graph` is the view graph that it was estimated from, and
  /// `neededPoints` the number of points that determined a pose.
  package func run(
    _ reconstruction: Reconstruction, _ graph: ViewGraph, features: [FeatureSet],
    images: ImageStore, neededPoints: Int = IncrementalMapping.Options().minimumInliers,
    _ context: StageContext
  ) throws -> Findings {
    let comparisons = try comparisons(reconstruction, features: features, images: images, context)
    let repetition = RepeatedStructure(reconstruction, features: features)
    var findings = Findings()
    findings.compared = comparisons.count(where: isInformative)
    findings.conflicts = comparisons.filter(isConflict).sorted {
      ($1.contradictingCells, $0.pair) < ($0.contradictingCells, $1.pair)
    }
    // What stands still contradicts a map of an object that moves, where it is still matched.
    findings.contradicted =
      graph.omitsSurroundings
      ? [] : graph.contradicted(by: reconstruction, features: features, repetition, options)
    func isSign(_ count: Int, of all: Int, minimum: Int, share: Double) -> Bool {
      count >= minimum && Double(count) >= share * Double(all)
    }
    let signs = [
      isSign(
        findings.conflicts.count, of: findings.compared, minimum: options.minimumConflicts,
        share: options.minimumConflictShare),
      isSign(
        findings.contradicted.count, of: graph.pairs.count, minimum: options.minimumContradicted,
        share: options.minimumContradictedShare),
    ]
    findings.placements = try PlacementDetection(options: options.placements)
      .groups(
        signs[0] ? comparisons : [], reconstruction, graph, repetition, neededPoints: neededPoints,
        context.control.part(from: 1, to: 1))
    findings.verdict =
      !signs.contains(true) ? .consistent : signs.contains(false) ? .ambiguous : .inconsistent
    context.notes.record("ambiguityConflicts", Double(findings.conflicts.count))
    context.notes.record("placements", Double(findings.placements.groups.count))
    findings.placements.explanation.map(context.notes.log)
    context.notes.record("contradictedPairs", Double(findings.contradicted.count))
    return findings
  }

  /// A comparison of every two photos that a reconstruction places close together, sorted by pair.
  package func comparisons(
    _ reconstruction: Reconstruction, features: [FeatureSet], images: ImageStore,
    _ context: StageContext
  ) throws -> [Comparison] {
    let test = VisibilityTest(
      SparseMap(reconstruction), features: features, photos: reconstruction.photos, images: images,
      options)
    let hypotheses = try test.hypotheses(context.control.part(from: 0, to: 0.2))
    var found: [PhotoPair: Comparison] = [:]
    for part in try test.evaluate(hypotheses, context.control.part(from: 0.2, to: 1)) {
      var sum = found[part.pair] ?? Comparison(pair: part.pair)
      sum.present += part.present
      sum.absent += part.absent
      sum.contradicting += part.contradicting
      sum.contradictingCells += part.contradictingCells
      found[part.pair] = sum
    }
    return found.values.sorted { $0.pair < $1.pair }
  }

  /// Whether enough points were searched for to decide whether the photos show the same.
  private func isInformative(_ comparison: Comparison) -> Bool {
    comparison.present.count + comparison.absent.count >= options.minimumPoints
  }

  /// Whether the photos show different parts of the scene.
  private func isConflict(_ comparison: Comparison) -> Bool {
    comparison.contradictingCells >= options.minimumCells
      && comparison.absent.count >= options.minimumPoints
  }
}

extension SceneAmbiguityCheck.Findings {
  /// An explanation that names up to three pairs of photos.
  package func reason(_ photos: [Photo]) -> String {
    func name(_ pair: PhotoPair) -> String {
      "\(photos[pair.first.index].name) and \(photos[pair.second.index].name)"
    }
    let pairs = conflicts.isEmpty ? contradicted : conflicts.map(\.pair)
    let shown = pairs.prefix(3).map(name).joined(separator: ", ")
    let more = pairs.count > 3 ? " and \(pairs.count - 3) more pairs" : ""
    return conflicts.isEmpty
      ? "\(shown)\(more) match, but the model places what they show at different positions"
      : "\(shown)\(more) show the same structure with different surroundings"
  }
}
