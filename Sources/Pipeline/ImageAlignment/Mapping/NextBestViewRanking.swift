import SceneModel

/// Next best view selection: ranks the photos by how many points of the map they observe and how
/// evenly these cover the frame (Schönberger and Frahm, "Structure-from-motion revisited", CVPR
/// 2016).
///
/// Scores are cached, so that a newly registered photo costs only the photos it affects.
struct NextBestViewRanking: Sendable {
  private let photos: [Photo]
  private var scores: [Int]

  /// The ranking of a map without points.
  init(_ photos: [Photo]) {
    self.photos = photos
    scores = photos.map { _ in 0 }
  }

  /// Recomputes the scores of the photos that observe an added or removed point.
  mutating func update(_ map: inout SparseMap) {
    for photo in map.takeChangedPhotos() where !map.isRegistered(photo) {
      scores[photo] = score(photo, map)
    }
  }

  /// The photos that observe points, the best first.
  func photos(where isCandidate: (Int) -> Bool) -> [Int] {
    scores.indices.filter { scores[$0] > 0 && isCandidate($0) }
      .sorted { (-scores[$0], $0) < (-scores[$1], $1) }
  }

  /// Counts the occupied cells of grids of 2×2 to 32×32 over the photo, weighted by resolution.
  private func score(_ photo: Int, _ map: SparseMap) -> Int {
    let finest = 32  // Chosen: a power of two, as it is halved down to 2.
    let size = SIMD2(Double(photos[photo].width), Double(photos[photo].height))
    var cells = [Bool](repeating: false, count: finest * finest)
    for index in map.tracks.observationsOfPhoto[photo]
    where map.isTriangulated[Int(map.tracks.trackOfObservation[Int(index)])] {
      let position = map.tracks.pixels[Int(index)] / size * Double(finest)
      let last = Double(finest - 1)
      let (x, y) = (Int(min(last, max(0, position.x))), Int(min(last, max(0, position.y))))
      cells[y * finest + x] = true
    }
    var (score, side) = (0, finest)
    while side >= 2 {
      score += side * side * cells.count { $0 }
      var coarser = [Bool](repeating: false, count: side * side / 4)
      for index in cells.indices where cells[index] {
        coarser[(index / side / 2) * (side / 2) + (index % side) / 2] = true
      }
      (cells, side) = (coarser, side / 2)
    }
    return score
  }
}
