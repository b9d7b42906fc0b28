import SceneModel

extension IncrementalMapping {
  /// An explanation for each photo that has no pose.
  func unregistered(
    _ map: SparseMap, others: [SparseMap], _ graph: ViewGraph, _ features: [FeatureSet],
    _ photos: [Photo]
  ) -> [RejectedPhoto] {
    let reasons = UnregisteredPhotoDiagnosis(
      map: map, others: others, graph: graph, features: features, photos: photos,
      neededPoints: options.relaxedMinimumInliers)
    return photos.filter { !map.isRegistered($0.id.index) }.map { photo in
      RejectedPhoto(
        sampleID: photo.sampleID, name: photo.name, fault: .notRegistered,
        reason: "\(photo.name) \(reasons.reason(photo.id.index)).")
    }
  }
}

/// Explains why photos have no pose, naming the photos with the strongest overlap.
private struct UnregisteredPhotoDiagnosis {
  /// An overlap with another photo.
  struct Link {
    var other: Int
    var matches: Int
    /// Number of matches that would suffice; nil for verified pairs.
    var needed: Int?
    /// Median triangulation angle of the matches in radians.
    var angle: Double
  }

  let map: SparseMap
  let others: [SparseMap]
  let features: [FeatureSet]
  let photos: [Photo]
  let neededPoints: Int
  /// The links of each photo, the strongest first.
  private var links: [[Link]]

  /// Fewer matches may occur by chance. Chosen.
  private static let chanceMatches = 8
  /// Pairs below this median triangulation angle, in radians, share one viewpoint. Chosen.
  private static let sameViewpointAngle = 0.5 * Double.pi / 180

  init(
    map: SparseMap, others: [SparseMap], graph: ViewGraph, features: [FeatureSet],
    photos: [Photo], neededPoints: Int
  ) {
    (self.map, self.others) = (map, others)
    (self.features, self.photos, self.neededPoints) = (features, photos, neededPoints)
    var links = [[Link]](repeating: [], count: photos.count)
    func add(_ pair: PhotoPair, _ matches: Int, _ needed: Int?, _ angle: Double) {
      let (a, b) = (pair.first.index, pair.second.index)
      links[a].append(Link(other: b, matches: matches, needed: needed, angle: angle))
      links[b].append(Link(other: a, matches: matches, needed: needed, angle: angle))
    }
    for pair in graph.pairs { add(pair.pair, pair.matches.count, nil, pair.medianAngle) }
    for pair in graph.rejected where pair.matches >= Self.chanceMatches {
      add(pair.pair, pair.matches, pair.needed, 0)
    }
    self.links = links.map { $0.sorted { ($1.matches, $0.other) < ($0.matches, $1.other) } }
  }

  /// A photo with less of its detail is blurred. Chosen: half the pixels would show as much.
  private static let minimumDetail = 0.5

  /// A sentence without its subject, the name of the photo, and without the final period.
  func reason(_ photo: Int) -> String {
    if photos[photo].detail(at: photos[photo].width * photos[photo].height) < Self.minimumDetail {
      return "is blurred, and shares too few features with the other photos; take it again with a "
        + "steady, focused camera"
    }
    let verified = links[photo].filter { $0.needed == nil }
    if let group = others.first(where: { $0.isRegistered(photo) }) {
      return separate(photo, in: group)
    }
    if features[photo].count < FeatureExtraction.fewFeatures {
      return "shows hardly any texture (\(features[photo].count) features); "
        + "take it sharper, in better light, or with something textured next to the object"
    }
    guard let strongest = verified.first else { return isolated(links[photo].first) }
    if verified.allSatisfy({ $0.angle < Self.sameViewpointAngle }) {
      return "was taken from the same place as \(name(strongest.other)), so that it adds no "
        + "depth information; step aside between photos"
    }
    guard let aligned = verified.first(where: { map.isRegistered($0.other) }) else {
      return "overlaps with \(name(strongest.other)) (\(strongest.matches) matches), but not "
        + "enough with any aligned photo" + closest([photo]) + "; add photos in between"
    }
    return insufficientOverlap(photo, aligned)
  }

  private func name(_ photo: Int) -> String { photos[photo].name }

  private func isolated(_ link: Link?) -> String {
    let advice = "it needs sharp texture and an overlap of two thirds with its neighbors"
    guard let link, let needed = link.needed else {
      return "shares no matches with any other photo; \(advice)"
    }
    return "shares only \(link.matches) matches with \(name(link.other)), the most similar photo, "
      + "where \(needed) are needed; \(advice)"
  }

  /// Only the reason of the group's first photo says what is missing.
  private func separate(_ photo: Int, in group: SparseMap) -> String {
    let members = group.registered.sorted()
    if photo != members[0] { return "belongs to the separate group of \(name(members[0]))" }
    return "belongs to a separate group of \(members.count) photos "
      + "(\(name(members[0])) to \(name(members[members.count - 1]))) that could not be joined "
      + "with the rest" + closest(members) + "; add photos between the two groups"
  }

  /// The strongest link from one of the photos to an aligned photo.
  private func closest(_ members: [Int]) -> String {
    let best = members.flatMap { photo in
      links[photo].filter { map.isRegistered($0.other) }.map { (photo: photo, link: $0) }
    }.max { ($0.link.matches, -$0.photo) < ($1.link.matches, -$1.photo) }
    guard let best else { return "" }
    return "; closest are \(name(best.photo)) and \(name(best.link.other)) with "
      + "\(best.link.matches) matches"
      + (best.link.needed.map { " where \($0) are needed" } ?? "")
  }

  /// The explanation for a photo with verified links to aligned photos.
  private func insufficientOverlap(_ photo: Int, _ link: Link) -> String {
    let seen = map.tracks.observationsOfPhoto[photo]
      .count { map.isTriangulated[Int(map.tracks.trackOfObservation[Int($0)])] }
    let start = "overlaps with \(name(link.other)) (\(link.matches) matches), but "
    if seen < neededPoints {
      return start
        + "sees only \(seen) points of the other photos, where \(neededPoints) are "
        + "needed; add photos in between"
    }
    return start + "the \(seen) points that it sees disagree about its position; "
      + "add photos from nearby"
  }
}
