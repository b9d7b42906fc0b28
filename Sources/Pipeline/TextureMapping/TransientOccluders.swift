import SceneModel

/// Detects views of triangles that show transient occluders or reflections instead of the surface:
/// a passer-by, a hand, a highlight.
///
/// Per triangle, views far from the median color are outliers, as in Waechter et al. (ECCV 2014). A
/// connected outlier region of sufficient area in one photo is an occluder. Parts of an occluder
/// resemble the surface behind it, and its boundary is blurred: next to it a lower threshold
/// applies (hysteresis as in Canny, PAMI 1986), and adjacent triangles are rejected too. Where only
/// one or two photos see the surface, there is no meaningful median; there the region grows as long
/// as the photo shows the occluder's color.
struct TransientOccluders: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Views that differ from the median by more are outliers; gray levels, 0…255.
    var colorTolerance: Float = 14
    /// The same in standard deviations of the views.
    var deviations: Float = 3
    /// Minimum number of views for a meaningful median.
    var minimumViews = 3
    /// Minimum area of a connected outlier region, in pixels of a photo; larger in large photos.
    var minimumRegionPixels: Float = 400
    /// Share of the tolerance that suffices next to outliers (the low hysteresis threshold).
    var lowThresholdShare: Float = 0.5
    /// Minimum similarity to the occluder's color for a neighbor without other evidence: 0 is the
    /// surface's color, 1 the occluder's.
    var colorSimilarity: Float = 0.7
    /// The same where too few photos see the surface.
    var unverifiedColorSimilarity: Float = 0.5
    /// Rings of triangles around an occluder that its blurred boundary may cover.
    var rings = 2
  }

  var options = Options()

  /// Whether each entry is rejected. A triangle whose views are all rejected only for their
  /// proximity to occluders keeps them; one whose views all show occluders keeps none.
  func run(
    _ views: FaceViews, topology: MeshTopology, _ context: StageContext
  ) throws -> [Bool] {
    let first = try rated(views, without: nil, context)
    let neighbors = FaceNeighbors(topology, faceCount: views.faceCount)
    var isOccluder = [Bool](repeating: false, count: views.entries.count)
    var occluderRegions: [[Int]] = []
    for occluder in occluders(first.excess, views, neighbors) {
      for entry in occluder { isOccluder[entry] = true }
      let occluderColor = OccluderColor(
        occluder.filter { first.excess[$0] > 1 }, views, first.medians)
      occluderRegions.append(
        extend(occluder, over: views, neighbors, first.excess, occluderColor, &isOccluder))
    }
    // Two occluders can outvote the surface of a triangle; without them it is re-evaluated.
    let second = try rated(views, without: isOccluder, context)
    for entry in views.entries.indices where second.excess[entry] > 1 { isOccluder[entry] = true }
    var isOutlier = isOccluder
    for occluder in occluderRegions { grow(occluder, views, neighbors, &isOutlier) }
    for face in 0..<views.faceCount where views.range(of: face).allSatisfy({ isOutlier[$0] }) {
      for entry in views.range(of: face) { isOutlier[entry] = isOccluder[entry] }
    }
    return isOutlier
  }

  /// The median color of each triangle, and each view's deviation from it relative to the
  /// tolerance. With two views neither is an outlier, but their difference is recorded.
  private func rated(
    _ views: FaceViews, without isOccluder: [Bool]?, _ context: StageContext
  ) throws -> (medians: [SIMD3<Float>], excess: [Float]) {
    let rated = try context.control.parallelMap(
      views.faceCount, inUnitsOf: FaceViews.parallelUnit
    ) { rate($0, of: views, without: isOccluder) }
    return (rated.map(\.median), rated.flatMap(\.excess))
  }

  /// The median color of one triangle, and the deviation of each of its views.
  private func rate(
    _ face: Int, of views: FaceViews, without isOccluder: [Bool]?
  ) -> (median: SIMD3<Float>, excess: [Float]) {
    let range = views.range(of: face)
    let entries = range.filter { !(isOccluder?[$0] ?? false) }
    var excess = [Float](repeating: 0, count: range.count)
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
      for entry in entries { excess[entry - range.lowerBound] = min(1, share) }
    } else if entries.count >= options.minimumViews {
      let limit = pointwiseMax(deviation * (1.4826 * options.deviations), tolerance)
      for (entry, color) in zip(entries, colors) {
        excess[entry - range.lowerBound] = Self.largest((color - median) / limit)
      }
    }
    return (median, excess)
  }

  private static func largest(_ v: SIMD3<Float>) -> Float { pointwiseMax(v, -v).max() }

  /// Regions of connected entries of one view above the low threshold that contain a sufficient
  /// area above the high one.
  private func occluders(
    _ excess: [Float], _ views: FaceViews, _ neighbors: FaceNeighbors
  ) -> [[Int]] {
    var isVisited = [Bool](repeating: false, count: excess.count)
    var occluders: [[Int]] = []
    for seed in excess.indices where excess[seed] > 1 && !isVisited[seed] {
      isVisited[seed] = true
      let group = neighbors.flood(from: [seed], in: views) { other in
        guard !isVisited[other], excess[other] > options.lowThresholdShare,
          hasEnoughViews(other, views)
        else { return false }
        isVisited[other] = true
        return true
      }
      let area = group.reduce(Float(0)) { $0 + (excess[$1] > 1 ? views.entries[$1].area : 0) }
      if area >= options.minimumRegionPixels { occluders.append(group) }
    }
    return occluders
  }

  /// Whether enough views see the entry's triangle for a meaningful median.
  private func hasEnoughViews(_ entry: Int, _ views: FaceViews) -> Bool {
    views.range(of: Int(views.entries[entry].face)).count >= options.minimumViews
  }

  /// Grows an occluder region by color over triangles that too few views see, or that other
  /// occluders also hide. Returns the whole region.
  private func extend(
    _ occluder: [Int], over views: FaceViews, _ neighbors: FaceNeighbors, _ excess: [Float],
    _ occluderColor: OccluderColor, _ isOccluder: inout [Bool]
  ) -> [Int] {
    neighbors.flood(from: occluder, in: views) { other in
      guard !isOccluder[other] else { return false }
      let isAlone = views.range(of: Int(views.entries[other].face)).count == 1
      let mayDiffer =
        !hasEnoughViews(other, views) && (isAlone || excess[other] > options.lowThresholdShare)
      let share = occluderColor.share(of: views.entries[other].color)
      guard share > (mayDiffer ? options.unverifiedColorSimilarity : options.colorSimilarity) else {
        return false
      }
      isOccluder[other] = true
      return true
    }
  }

  /// Marks the rings of triangles around an occluder region.
  private func grow(
    _ occluder: [Int], _ views: FaceViews, _ neighbors: FaceNeighbors, _ isOutlier: inout [Bool]
  ) {
    var front = occluder
    for _ in 0..<options.rings {
      var next: [Int] = []
      for entry in front {
        neighbors.forEach(adjacentTo: entry, in: views) { other in
          guard !isOutlier[other] else { return }
          isOutlier[other] = true
          next.append(other)
        }
      }
      front = next
    }
  }

  /// The mean color of an occluder and of the surface behind it.
  private struct OccluderColor {
    private var occluder = SIMD3<Float>.zero
    private var surface = SIMD3<Float>.zero

    init(_ entries: [Int], _ views: FaceViews, _ medians: [SIMD3<Float>]) {
      let share = 1 / Float(max(1, entries.count))
      for entry in entries {
        occluder += views.entries[entry].color * share
        surface += medians[Int(views.entries[entry].face)] * share
      }
    }

    /// Position of a color on the line from the surface's color, 0, to the occluder's, 1.
    func share(of color: SIMD3<Float>) -> Float {
      let direction = occluder - surface
      return (color - surface).dot(direction) / max(direction.squaredLength, 1e-6)
    }
  }
}
