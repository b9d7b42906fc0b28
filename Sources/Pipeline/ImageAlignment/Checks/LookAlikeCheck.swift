import Kernels
import SceneModel

/// Tells whether parts of the scene that look alike have been laid on each other.
///
/// Two sides of a box, or two bays of a facade, share features like two photos of one side, and the map
/// folds. Two things give it away. Some pairs match the right parts and some the wrong ones, so that
/// strong pairs contradict the reconstruction. And photos that have been put at nearly the same place
/// differ beside what is alike: the one shows points that nothing hides from the other, and whose
/// texture isn't there (after Zach et al., "What can missing correspondences tell us about 3D structure
/// and motion?", CVPR 2008, and Heinly et al., "Correcting for duplicate scene structure in sparse 3D
/// reconstruction", ECCV 2014). A feature that is missing proves nothing, so the texture is looked for.
package struct LookAlikeCheck: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Photos that each one is compared with: the nearest.
    package var neighbours = 4
    /// Their largest distance relative to the median depth, and the largest angle of the optical axes.
    package var relativeDistance = 0.6
    package var axisDegrees = 45.0
    /// Points count that both photos see from directions up to this angle apart, in degrees, and from
    /// distances up to this ratio.
    package var maximumAngleDegrees = 20.0
    package var maximumDistanceRatio = 1.4
    /// Points of a photo that are looked for in another at most.
    package var maximumPoints = 150
    /// A point further away than what the photo shows around it, by more than this ratio, may be hidden.
    package var depthTolerance = 1.03
    /// Distance of a template's samples in σ of its feature, and at least as a fraction of the photo's
    /// longer side.
    package var stepPerScale = 1.0 / 3
    package var relativeStep = 1.0 / 1400
    /// Photos of more pixels are reduced to this size.
    package var workingPixels = 6_500_000
    /// Correlation from which on a point is there, and below which it isn't.
    package var agreement = 0.75
    package var contradiction = 0.5
    /// Cells along the longer side of a photo; one with this many points that aren't there, and less
    /// than half as many that are, contradicts.
    package var cells = 20
    package var cellPoints = 2
    /// Contradicting cells of both photos together, and points in them, that make the photos differ.
    package var minimumCells = 6
    package var minimumPoints = 12
    /// Share of the pairs of photos close together that have to differ, and how many at least.
    package var minimumConflictShare = 0.1
    package var minimumConflicts = 2
    /// Pairs whose matches contradict the reconstruction from which on it is doubted.
    package var minimumContradicted = 2

    package init() {}
  }

  /// What two photos say about being at nearly the same place.
  package struct Evidence: Hashable, Sendable {
    package var pair: PhotoPair
    /// Points that feature matching found in one of the photos only and whose texture both show.
    package var agreeing = 0
    /// Points that one shows and the other, which should, doesn't.
    package var contradicting = 0
    /// Cells of the photos in which points contradict.
    package var contradictingCells = 0
  }

  /// What speaks against a reconstruction.
  package struct Findings: Hashable, Sendable {
    /// Pairs of photos close together that could be compared.
    package var compared = 0
    /// Those that show different things, the most different first.
    package var conflicts: [Evidence] = []
    /// Pairs of photos whose matches contradict the reconstruction, sorted.
    package var contradicted: [PhotoPair] = []
    package var verdict = Verdict.sound
  }

  package enum Verdict: Hashable, Sendable {
    case sound
    /// One of the two signs is there.
    case doubtful
    /// Both are.
    case folded
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// `graph` is what the reconstruction was made of.
  package func run(
    _ reconstruction: Reconstruction, _ graph: ViewGraph, features: [FeatureSet],
    images: ImageStore, _ context: StageContext
  ) throws -> Findings {
    let evidence = try evidence(reconstruction, features: features, images: images, context)
    var findings = Findings()
    findings.compared = evidence.count
    findings.conflicts = evidence.filter(isConflict).sorted {
      ($1.contradictingCells, $0.pair) < ($0.contradictingCells, $1.pair)
    }
    findings.contradicted = graph.contradicted(by: reconstruction, features: features)
    let needed = max(
      Double(options.minimumConflicts), options.minimumConflictShare * Double(evidence.count))
    let signs = [
      Double(findings.conflicts.count) >= needed,
      findings.contradicted.count >= options.minimumContradicted,
    ]
    findings.verdict =
      !signs.contains(true) ? .sound : signs.contains(false) ? .doubtful : .folded
    context.notes.count("lookAlikeConflicts", Double(findings.conflicts.count))
    context.notes.count("contradictedPairs", Double(findings.contradicted.count))
    return findings
  }

  /// The evidence on every two photos that a reconstruction puts close together, sorted by pair.
  package func evidence(
    _ reconstruction: Reconstruction, features: [FeatureSet], images: ImageStore,
    _ context: StageContext
  ) throws -> [Evidence] {
    let search = NearbySearch(
      SparseMap(reconstruction), features: features, photos: reconstruction.photos, images: images,
      options)
    let questions = try search.questions(context.control.part(from: 0, to: 0.2))
    var found: [PhotoPair: Evidence] = [:]
    for part in try search.answers(questions, context.control.part(from: 0.2, to: 1)) {
      var sum = found[part.pair] ?? Evidence(pair: part.pair)
      sum.agreeing += part.agreeing
      sum.contradicting += part.contradicting
      sum.contradictingCells += part.contradictingCells
      found[part.pair] = sum
    }
    return found.values.sorted { $0.pair < $1.pair }
  }

  /// Whether the photos show different things.
  private func isConflict(_ evidence: Evidence) -> Bool {
    evidence.contradictingCells >= options.minimumCells
      && evidence.contradicting >= options.minimumPoints
  }
}

extension LookAlikeCheck.Findings {
  /// A sentence that names the photos.
  package func reason(_ photos: [Photo]) -> String {
    func name(_ pair: PhotoPair) -> String {
      "\(photos[pair.first.index].name) and \(photos[pair.second.index].name)"
    }
    let pairs = conflicts.isEmpty ? contradicted : conflicts.map(\.pair)
    let shown = pairs.prefix(3).map(name).joined(separator: ", ")
    let more = pairs.count > 3 ? " and \(pairs.count - 3) more pairs" : ""
    return conflicts.isEmpty
      ? "\(shown)\(more) match, and the model puts what they show in different places"
      : "\(shown)\(more) show the same in part and something else beside it"
  }
}
