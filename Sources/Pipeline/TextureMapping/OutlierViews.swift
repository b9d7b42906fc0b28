import SceneModel

/// Finds the views of triangles that show something else than the surface: a passer-by, a hand, a
/// reflection.
///
/// Per triangle, views far from the median colour stand out, as in Waechter et al. (ECCV 2014). What
/// stands out in one photo over many pixels is a thing, and a thing has parts that look like the
/// surface behind it, and a blurred rim: from there on, less is enough (the hysteresis of Canny,
/// PAMI 1986), and the triangles beside it go as well. Where one or two photos see the surface, no
/// median tells; there the thing goes on as long as the photo shows its colour.
struct OutlierViews: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Views that disagree with the median by more stand out; gray levels 0…255.
    var colorTolerance: Float = 14
    /// The same in standard deviations of the views.
    var deviations: Float = 3
    /// The least number of views that tell which of them is the odd one.
    var minimumViews = 3
    /// Pixels of a photo that stand out side by side and are a thing; in large photos it takes more.
    var thingArea: Float = 400
    /// Share of the tolerance that is enough beside what stands out.
    var weakShare: Float = 0.5
    /// How like a thing's colour one beside it must be, if nothing else tells: 0 is the surface's.
    var likeness: Float = 0.7
    /// Rings of triangles around a thing that its rim may reach.
    var rings = 2
  }

  var options = Options()

  /// For each entry whether it is to be left out. A triangle whose views are all beside things
  /// keeps them; one that only shows things keeps none.
  func run(
    _ views: FaceViews, topology: MeshTopology, _ context: StageContext
  ) throws -> [Bool] {
    let first = try rated(views, without: nil, context)
    let neighbors = FaceNeighbors(topology, faceCount: views.faceCount)
    var isStranger = [Bool](repeating: false, count: views.entries.count)
    var strangers: [[Int]] = []
    for thing in things(first.excess, views, neighbors) {
      for entry in thing { isStranger[entry] = true }
      let look = Look(thing.filter { first.excess[$0] > 1 }, views, first.medians)
      strangers.append(
        extend(thing, over: views, neighbors, first.excess, look, &isStranger))
    }
    // Two things on one triangle outvote its surface; without them it is judged anew.
    let second = try rated(views, without: isStranger, context)
    for entry in views.entries.indices where second.excess[entry] > 1 { isStranger[entry] = true }
    var isOutlier = isStranger
    for thing in strangers { grow(thing, views, neighbors, &isOutlier) }
    for face in 0..<views.faceCount where views.range(of: face).allSatisfy({ isOutlier[$0] }) {
      for entry in views.range(of: face) { isOutlier[entry] = isStranger[entry] }
    }
    return isOutlier
  }

  /// The median colour of each triangle, and how far each view is from it, as a share of what is
  /// tolerated. Of two views neither stands out, but they may differ.
  private func rated(
    _ views: FaceViews, without isStranger: [Bool]?, _ context: StageContext
  ) throws -> (medians: [SIMD3<Float>], excess: [Float]) {
    var medians = [SIMD3<Float>](repeating: .zero, count: views.faceCount)
    var excess = [Float](repeating: 0, count: views.entries.count)
    for face in 0..<views.faceCount {
      if face % 16384 == 0 { try context.step(face, of: views.faceCount) }
      let entries = views.range(of: face).filter { !(isStranger?[$0] ?? false) }
      medians[face] = rate(entries, of: views, &excess)
    }
    return (medians, excess)
  }

  private func rate(
    _ entries: [Int], of views: FaceViews, _ excess: inout [Float]
  ) -> SIMD3<Float> {
    let colors = entries.map { views.entries[$0].color }
    var median = SIMD3<Float>.zero
    var deviation = SIMD3<Float>.zero
    for channel in 0..<3 {
      median[channel] = colors.map { $0[channel] }.upperMedian ?? 0
      deviation[channel] = colors.map { abs($0[channel] - median[channel]) }.upperMedian ?? 0
    }
    let tolerance = SIMD3<Float>(repeating: options.colorTolerance)
    if entries.count == 2 {
      let share = Self.largest((colors[0] - colors[1]) / tolerance)
      for entry in entries { excess[entry] = min(1, share) }
    } else if entries.count >= options.minimumViews {
      let limit = pointwiseMax(deviation * (1.4826 * options.deviations), tolerance)
      for (entry, color) in zip(entries, colors) {
        excess[entry] = Self.largest((color - median) / limit)
      }
    }
    return median
  }

  private static func largest(_ v: SIMD3<Float>) -> Float { pointwiseMax(v, -v).max() }

  /// Connected entries of one view that stand out a little, of which many stand out clearly.
  private func things(
    _ excess: [Float], _ views: FaceViews, _ neighbors: FaceNeighbors
  ) -> [[Int]] {
    var isVisited = [Bool](repeating: false, count: excess.count)
    var things: [[Int]] = []
    for seed in excess.indices where excess[seed] > 1 && !isVisited[seed] {
      isVisited[seed] = true
      let group = neighbors.flood(from: [seed], in: views) { other in
        guard !isVisited[other], excess[other] > options.weakShare, isJudged(other, views)
        else { return false }
        isVisited[other] = true
        return true
      }
      let area = group.reduce(Float(0)) { $0 + (excess[$1] > 1 ? views.entries[$1].area : 0) }
      if area >= options.thingArea { things.append(group) }
    }
    return things
  }

  /// Whether enough views see the triangle of an entry to tell which is the odd one.
  private func isJudged(_ entry: Int, _ views: FaceViews) -> Bool {
    views.range(of: Int(views.entries[entry].face)).count >= options.minimumViews
  }

  /// Follows a thing by its colour over triangles that too few views see, or that other things
  /// hide as well. Returns all of it.
  private func extend(
    _ thing: [Int], over views: FaceViews, _ neighbors: FaceNeighbors, _ excess: [Float],
    _ look: Look, _ isStranger: inout [Bool]
  ) -> [Int] {
    neighbors.flood(from: thing, in: views) { other in
      guard !isStranger[other] else { return false }
      let isAlone = views.range(of: Int(views.entries[other].face)).count == 1
      let mayDiffer = !isJudged(other, views) && (isAlone || excess[other] > options.weakShare)
      let share = look.share(of: views.entries[other].color)
      guard share > (mayDiffer ? 0.5 : options.likeness) else { return false }
      isStranger[other] = true
      return true
    }
  }

  private func grow(
    _ thing: [Int], _ views: FaceViews, _ neighbors: FaceNeighbors, _ isOutlier: inout [Bool]
  ) {
    var rim = thing
    for _ in 0..<options.rings {
      var next: [Int] = []
      for entry in rim {
        neighbors.forEach(beside: entry, in: views) { other in
          guard !isOutlier[other] else { return }
          isOutlier[other] = true
          next.append(other)
        }
      }
      rim = next
    }
  }

  /// What sets a thing's colours apart from the surface behind it: the mean of both.
  private struct Look {
    private var thing = SIMD3<Float>.zero
    private var surface = SIMD3<Float>.zero

    init(_ entries: [Int], _ views: FaceViews, _ medians: [SIMD3<Float>]) {
      let share = 1 / Float(max(1, entries.count))
      for entry in entries {
        thing += views.entries[entry].color * share
        surface += medians[Int(views.entries[entry].face)] * share
      }
    }

    /// Where a colour is on the line from the surface's, 0, to the thing's, 1.
    func share(of color: SIMD3<Float>) -> Float {
      let way = thing - surface
      return (color - surface).dot(way) / max(way.squaredLength, 1e-6)
    }
  }
}

/// The triangles that share an edge with each triangle.
struct FaceNeighbors: Sendable {
  /// Three a triangle, −1 where there is none.
  private var faces: [Int32]

  init(_ topology: MeshTopology, faceCount: Int) {
    faces = Array(repeating: -1, count: 3 * faceCount)
    for edge in topology.edges where edge.second >= 0 {
      add(edge.second, to: edge.first)
      add(edge.first, to: edge.second)
    }
  }

  private mutating func add(_ neighbor: Int32, to face: Int32) {
    let start = 3 * Int(face)
    guard let place = (start..<start + 3).first(where: { faces[$0] < 0 }) else { return }
    faces[place] = neighbor
  }

  /// `start`, then what the same view shows beside it and accepts, and so on.
  func flood(
    from start: [Int], in views: FaceViews, where accepts: (Int) -> Bool
  ) -> [Int] {
    var group = start
    var next = 0
    while next < group.count {
      forEach(beside: group[next], in: views) { if accepts($0) { group.append($0) } }
      next += 1
    }
    return group
  }

  /// Calls `body` with what the same view shows of the triangles beside that of `entry`.
  func forEach(beside entry: Int, in views: FaceViews, _ body: (Int) -> Void) {
    let (face, view) = (Int(views.entries[entry].face), views.entries[entry].view)
    for place in 3 * face..<3 * face + 3 where faces[place] >= 0 {
      if let other = views.index(of: Int(faces[place]), in: view) { body(other) }
    }
  }
}
