import Kernels

/// The observations of each triangle in the views, ascending by view.
typealias FaceViews = FaceEntries<FaceObservation>

extension FaceEntries<FaceObservation> {
  /// The number of observations.
  var count: Int { blocks.reduce(0) { $0 + $1.entries.count } }

  /// Groups observations by triangle. `pieces` holds them by block, then by view, and is left
  /// empty. `maximumCount` observations of each triangle are kept: those with the largest area.
  init(
    draining pieces: inout [[[FaceObservation]]], faceCount: Int, maximumCount: Int = .max,
    _ control: KernelControl
  ) throws {
    self.init(
      blocks: try control.parallelMap(draining: &pieces) { index, views in
        var block = Block(views, of: FaceBlocks.faces(of: index, faceCount: faceCount))
        block.limit(toLargest: maximumCount)
        return block
      })
  }

  /// Groups observations, listed by view, by triangle.
  init(faceCount: Int, observationsByView: [[FaceObservation]]) throws {
    var pieces = [[[FaceObservation]]](
      repeating: [], count: FaceBlocks.count(faceCount: faceCount))
    for observations in observationsByView {
      for (block, piece) in Self.pieces(of: observations, faceCount: faceCount).enumerated() {
        pieces[block].append(piece)
      }
    }
    try self.init(draining: &pieces, faceCount: faceCount, KernelControl())
  }

  /// Divides observations, which ascend by triangle, into those of each block.
  static func pieces(
    of observations: [FaceObservation], faceCount: Int
  ) -> [[FaceObservation]] {
    var start = 0
    return (0..<FaceBlocks.count(faceCount: faceCount)).map { block in
      let limit = FaceBlocks.faces(of: block, faceCount: faceCount).upperBound
      var end = start
      while end < observations.count, observations[end].face < limit { end += 1 }
      defer { start = end }
      return Array(observations[start..<end])
    }
  }

  /// The place of a view's observation of a triangle; nil if the view doesn't see it.
  func index(of face: Int, in view: Int32) -> Index? {
    let number = face / FaceBlocks.size
    let block = blocks[number]
    for entry in block.range(of: face % FaceBlocks.size)
    where block.entries[entry].view == view {
      return Index(block: Int32(number), entry: Int32(entry))
    }
    return nil
  }
}

extension FaceEntries<FaceObservation>.Block {
  /// Groups the observations of the triangles `faces`, listed by view.
  fileprivate init(_ views: [[FaceObservation]], of faces: Range<Int>) {
    var counts = [Int](repeating: 0, count: faces.count)
    for observations in views {
      for observation in observations { counts[Int(observation.face) - faces.lowerBound] += 1 }
    }
    let empty = FaceObservation(face: 0, area: 0, cosine: 0, gradient: 0, color: .zero)
    let total = counts.reduce(0, +)
    self.init(counts: counts, entries: Array(repeating: empty, count: total))
    var next = offsets
    for (view, observations) in views.enumerated() {
      for var observation in observations {
        observation.view = Int32(view)
        let face = Int(observation.face) - faces.lowerBound
        entries[Int(next[face])] = observation
        next[face] += 1
      }
    }
  }

  /// Keeps the largest observations of each triangle.
  fileprivate mutating func limit(toLargest maximum: Int) {
    var isKept = [Bool](repeating: true, count: entries.count)
    for face in 0..<faceCount {
      let range = range(of: face)
      guard range.count > maximum else { continue }
      let order = range.sorted { (entries[$0].area, $1) > (entries[$1].area, $0) }
      for index in order[maximum...] { isKept[index] = false }
    }
    filter { index, _ in isKept[index] }
  }
}
