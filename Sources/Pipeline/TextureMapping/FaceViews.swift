import Kernels

/// The observations of each triangle in the views.
struct FaceViews: Sendable {
  /// Observations of triangle i: `entries[offsets[i]..<offsets[i + 1]]`, ascending by view.
  private(set) var offsets: [Int32]
  var entries: [FaceObservation]

  /// Number of triangles that a thread works on at a time. Chosen: a few milliseconds.
  static let parallelUnit = 2048

  var faceCount: Int { offsets.count - 1 }

  /// Groups observations, listed by view, by triangle.
  init(faceCount: Int, observationsByView: [[FaceObservation]]) {
    offsets = Array(repeating: 0, count: faceCount + 1)
    for observations in observationsByView {
      for observation in observations { offsets[Int(observation.face) + 1] += 1 }
    }
    for index in 0..<faceCount { offsets[index + 1] += offsets[index] }
    var next = offsets
    let empty = FaceObservation(face: 0, area: 0, cosine: 0, gradient: 0, color: .zero)
    entries = Array(repeating: empty, count: Int(offsets[faceCount]))
    for (view, observations) in observationsByView.enumerated() {
      for var observation in observations {
        observation.view = Int32(view)
        let face = Int(observation.face)
        entries[Int(next[face])] = observation
        next[face] += 1
      }
    }
  }

  func range(of face: Int) -> Range<Int> { Int(offsets[face])..<Int(offsets[face + 1]) }

  /// The index in `entries` of a view's observation of a triangle; nil if the view doesn't see it.
  func index(of face: Int, in view: Int32) -> Int? {
    range(of: face).first { entries[$0].view == view }
  }

  /// Keeps the entries that satisfy the predicate.
  mutating func filter(_ isIncluded: (Int) -> Bool) {
    var kept: [FaceObservation] = []
    kept.reserveCapacity(entries.count)
    var newOffsets: [Int32] = [0]
    newOffsets.reserveCapacity(offsets.count)
    for face in 0..<faceCount {
      for index in range(of: face) where isIncluded(index) { kept.append(entries[index]) }
      newOffsets.append(Int32(kept.count))
    }
    (entries, offsets) = (kept, newOffsets)
  }
}
