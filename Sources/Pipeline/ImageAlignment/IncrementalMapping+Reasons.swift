import SceneModel

extension IncrementalMapping {
  /// A sentence for each photo that has no pose.
  func unregistered(
    _ map: SparseMap, others: [SparseMap], _ graph: ViewGraph, _ photos: [Photo]
  ) -> [RefusedPhoto] {
    var neighbours = [Int](repeating: 0, count: photos.count)
    var mostMatches = [Int](repeating: 0, count: photos.count)
    for pair in graph.pairs {
      for id in [pair.pair.first, pair.pair.second] {
        neighbours[id.index] += 1
        mostMatches[id.index] = max(mostMatches[id.index], pair.matches.count)
      }
    }
    return photos.filter { !map.isRegistered($0.id.index) }.map { photo in
      let index = photo.id.index
      let seen = map.tracks.observationsOfPhoto[index]
        .count { map.isTriangulated[Int(map.tracks.trackOfObservation[Int($0)])] }
      let group = others.first { $0.isRegistered(index) }
      let reason: String
      if let group {
        reason =
          "belongs to a separate group of \(group.registered.count) photos that doesn't overlap "
          + "with the rest; add photos between the two groups"
      } else if neighbours[index] == 0 {
        reason =
          "shares no matches with any other photo; it needs sharp texture and an overlap of two "
          + "thirds with its neighbours"
      } else if seen < options.relaxedMinimumInliers {
        reason =
          "overlaps with \(neighbours[index]) photos (\(mostMatches[index]) matches at most), none "
          + "of them aligned with the rest; add photos in between"
      } else {
        reason =
          "sees \(seen) points of the model, but too few of them agree on where it was taken from; "
          + "add photos from nearby"
      }
      return RefusedPhoto(
        sampleID: photo.sampleID, name: photo.name, fault: .notRegistered,
        reason: "\(photo.name) \(reason).")
    }
  }
}
