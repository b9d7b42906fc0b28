import SceneModel

/// Determines which photos overlap, without aligning them: the view graph that alignment with the
/// same options starts from.
package struct OverlapSurvey: Sendable {
  /// The overlaps of one photo.
  package struct Overlap: Hashable, Sendable {
    /// Another photo and the number of matches with it.
    package struct Partner: Hashable, Sendable {
      package var photo: ID<Photo>
      package var matches: Int
    }

    package var photo: ID<Photo>
    /// Number of features.
    package var features: Int
    /// Photos with a verified overlap, the most matches first.
    package var partners: [Partner]
    /// The photo with the most matches among those without a verified overlap.
    package var nearest: Partner?
  }

  /// The overlaps of all photos and the groups that they form.
  package struct Result: Sendable {
    /// Indexed by photo ID.
    package var overlaps: [Overlap]
    /// Photos connected by verified overlaps, the largest group first.
    package var groups: [[ID<Photo>]]
  }

  package var options: ImageAlignment.Options

  /// `options` are those of the alignment of the same photos.
  package init(_ options: ImageAlignment.Options) { self.options = options }

  /// Extracts and matches features; no poses are estimated.
  package func run(
    photos: [Photo], cameras: [Camera], images: ImageStore, _ context: StageContext
  ) throws -> Result {
    let matched = try ImageAlignment(options)
      .viewGraph(photos: photos, cameras: cameras, images: images, context)
    return Result(matched.graph, featureCounts: photos.map { matched.features[$0.id.index].count })
  }
}

extension OverlapSurvey.Result {
  /// Summarizes a view graph; `featureCounts` is indexed by photo ID.
  package init(_ graph: ViewGraph, featureCounts: [Int]) {
    overlaps = featureCounts.enumerated().map {
      OverlapSurvey.Overlap(photo: ID($0), features: $1, partners: [])
    }
    for pair in graph.pairs {
      let (a, b) = (pair.pair.first, pair.pair.second)
      overlaps[a.index].partners.append(.init(photo: b, matches: pair.matches.count))
      overlaps[b.index].partners.append(.init(photo: a, matches: pair.matches.count))
    }
    for pair in graph.rejected {
      for (a, b) in [(pair.pair.first, pair.pair.second), (pair.pair.second, pair.pair.first)]
      where pair.matches > overlaps[a.index].nearest?.matches ?? 0 {
        overlaps[a.index].nearest = .init(photo: b, matches: pair.matches)
      }
    }
    for index in overlaps.indices {
      overlaps[index].partners.sort { ($1.matches, $0.photo) < ($0.matches, $1.photo) }
    }
    groups = graph.connectedGroups.map { $0.map { ID($0) } }
  }
}
