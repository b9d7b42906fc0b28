import Kernels
import SceneModel

/// Joining photos between which the object was moved.
extension ImageAlignment {
  /// The matches of all photos by the object that their masks leave, in addition to all matches
  /// within a placement, whose photos are linked by the surroundings as well. Among the features of
  /// the object alone, more matches are distinctive.
  func match(
    _ object: ObjectFeatures, of matched: MatchedPhotos, placements: [[Int]],
    _ context: StageContext
  ) throws -> MatchedPhotos {
    var photos = matched
    photos.photos = object.photos
    var search = options.search
    // Two photos without masks would match the surroundings.
    search.matchesUnmaskedPairs = false
    search.secondMotions.isEnabled = false
    var result = try match(photos, byFeatures: object.indices, search, context)
    result.graph.add(matched.graph, within: placements)
    result.graph.omitsSurroundings = matched.graph.omitsSurroundings
    return result
  }

  /// The same with features that are extracted again from the masked photos: without the
  /// surroundings, a photo holds more of the object.
  func match(
    _ masked: PhotoSet, of matched: MatchedPhotos, placements: [[Int]],
    sensitivity: FeatureSensitivity, _ context: StageContext
  ) throws -> (photos: MatchedPhotos, object: ObjectFeatures) {
    var alignment = self
    alignment.options.features.sensitivity = sensitivity
    alignment.options.correspondences.matchesUnmaskedPairs = false
    alignment.options.correspondences.secondMotions.isEnabled = false
    var result = try alignment.match(
      photos: masked.ingested.photos, cameras: matched.cameras, images: masked.images, context)
    let counts = result.features.map(\.count)
    for index in result.features.indices {
      result.features[index].appendWithoutDescriptors(matched.features[index])
    }
    result.graph.add(
      matched.graph.renumbered(
        zip(counts, matched.features).map { Array($0..<$0 + $1.count) },
        featureCounts: result.features.map(\.count)),
      within: placements)
    result.graph.omitsSurroundings = matched.graph.omitsSurroundings
    let isObject = zip(counts, result.features).map { count, set in
      (0..<set.count).map { $0 < count }
    }
    return (result, ObjectFeatures(photos: masked.ingested.photos, isObject: isObject))
  }

  /// Finishes a map of the object, and checks it: points of the surroundings are left out.
  /// `posesInUpFrame` has the poses of one placement's photos in a frame whose +y is up.
  func finish(
    _ map: Map, of object: ObjectFeatures, _ matched: MatchedPhotos, _ images: ImageStore,
    posesInUpFrame: [RigidTransform?], _ context: StageContext
  ) throws -> Reconstruction {
    var mapped = map.reconstruction
    for (index, photo) in object.photos.enumerated() { mapped.photos[index].mask = photo.mask }
    let result = try finish(mapped, matched, images, posesInUpFrame: posesInUpFrame, context) {
      point in
      let features = point.track.filter { $0.feature >= 0 }
      let onObject = features.count { object.isObject[$0.photo.index][Int($0.feature)] }
      return 2 * onObject > features.count
    }
    // What was taken for the object may be the surroundings.
    checkFocus(of: result, matched, context.notes) { nil }
    return result
  }
}

extension ViewGraph {
  /// Adds the matches of another graph between photos of the same group. A feature that is matched
  /// already keeps its match.
  fileprivate mutating func add(_ other: ViewGraph, within groups: [[Int]]) {
    var groupOf = [Int?](repeating: nil, count: photoCount)
    for (number, group) in groups.enumerated() { for photo in group { groupOf[photo] = number } }
    var known = Dictionary(uniqueKeysWithValues: pairs.map { ($0.pair, $0) })
    for var pair in other.pairs {
      let group = groupOf[pair.pair.first.index]
      guard let group, group == groupOf[pair.pair.second.index] else { continue }
      if let objectPair = known[pair.pair] {
        let (first, second) = (
          Set(objectPair.matches.map(\.first)), Set(objectPair.matches.map(\.second))
        )
        let more = pair.matches.filter { !first.contains($0.first) && !second.contains($0.second) }
        pair.matches = (objectPair.matches + more).sorted { $0.first < $1.first }
      }
      known[pair.pair] = pair
    }
    pairs = known.values.sorted { $0.pair < $1.pair }
  }
}

extension FeatureSet {
  /// Appends other features of the same photo, which have been matched and need no descriptors.
  fileprivate mutating func appendWithoutDescriptors(_ other: FeatureSet) {
    positions += other.positions
    scales += other.scales
    orientations += other.orientations
    colors += other.colors
  }
}
