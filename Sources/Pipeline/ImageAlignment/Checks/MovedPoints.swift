import SceneModel

/// The points that one photo shows and another one with nearly the same pose does not, while
/// hardly anything around them is there either: those of an object that was moved, and what it
/// hides.
///
/// All other points, of surroundings that stand still, are not informative about the object.
struct MovedPoints {
  /// Indices into the points of the reconstruction.
  private let points: Set<Int32>

  /// Of the points that contradict, those that are present more often than absent were only
  /// hidden.
  init(_ comparisons: [SceneAmbiguityCheck.Comparison]) {
    var balance: [Int32: Int] = [:]
    for comparison in comparisons {
      for point in comparison.present { balance[point, default: 0] -= 1 }
      for point in comparison.absent { balance[point, default: 0] += 1 }
    }
    points = Set(comparisons.flatMap(\.contradicting)).filter { balance[$0] ?? 0 >= 0 }
  }

  /// How many of some points were moved.
  func count(_ points: [Int32]) -> Int { points.count { self.points.contains($0) } }

  /// The number of moved points that two photos observe one after the other, in the order of
  /// capture. Each point links the photos that observe it in one chain, so that it counts once
  /// against each boundary between them.
  func covisibility(_ reconstruction: Reconstruction) -> [PhotoPair: Int] {
    var result: [PhotoPair: Int] = [:]
    for point in points {
      let photos = Set(reconstruction.points[Int(point)].track.map(\.photo)).sorted()
      for (photo, next) in zip(photos, photos.dropFirst()) {
        result[PhotoPair(photo, next), default: 0] += 1
      }
    }
    return result
  }
}
