extension Reconstruction {
  /// The part that some of the photos show: their poses, and the points that at least two of them
  /// observe.
  package func restricted(to group: [Int]) -> Reconstruction {
    let members = Set(group)
    var result = self
    for index in poses.indices where !members.contains(index) { result.poses[index] = nil }
    result.points = points.compactMap { point in
      var part = point
      part.track = point.track.filter { members.contains($0.photo.index) }
      return part.track.count > 1 ? part : nil
    }
    return result
  }
}
