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
    /// Views that differ from the median by more are outliers; gray levels, 0…255. Chosen.
    var colorTolerance: Float = 14
    /// The same in standard deviations of the views. Chosen.
    var deviations: Float = 3
    /// Minimum number of views for a meaningful median. Limit: the median of two is neither.
    var minimumViews = 3
    /// Minimum area of a connected outlier region, in pixels of a photo; larger in large photos.
    /// Chosen.
    var minimumRegionPixels: Float = 400
    /// Share of the tolerance that suffices next to outliers (the low hysteresis threshold). Paper:
    /// Canny 1986, hysteresis: a ratio of two or three to one.
    var lowThresholdShare: Float = 0.5
    /// Minimum similarity to the occluder's color for a neighbor without other evidence: 0 is the
    /// surface's color, 1 the occluder's. Chosen.
    var colorSimilarity: Float = 0.7
    /// The same where too few photos see the surface. Chosen.
    var unverifiedColorSimilarity: Float = 0.5
    /// Rings of triangles around an occluder that its blurred boundary may cover. Chosen.
    var rings = 2
  }

  var options = Options()

  /// How far a view is from the median color of a triangle's views.
  private enum Deviation: UInt8 {
    case small
    /// Above the low threshold.
    case elevated
    /// Above the tolerance.
    case outlier
  }

  private typealias Index = FaceViews.Index

  /// Whether each entry is rejected. A triangle whose views are all rejected only for their
  /// proximity to occluders keeps them; one whose views all show occluders keeps none.
  func run(
    _ views: FaceViews, topology: MeshTopology, _ context: StageContext
  ) throws -> EntryValues<Bool> {
    let control = context.control
    let deviations = EntryValues(
      blocks: try control.parallelMap(views.blocks.count) { self.deviations(in: views.blocks[$0]) })
    let neighbors = FaceNeighbors(topology, faceCount: views.faceCount)
    var isOccluder = EntryValues(repeating: false, for: views)
    var occluderRegions: [[Index]] = []
    for occluder in occluders(deviations, views, neighbors) {
      for entry in occluder { isOccluder[entry] = true }
      let color = occluderColor(occluder.filter { deviations[$0] == .outlier }, views)
      occluderRegions.append(
        extend(occluder, over: views, neighbors, deviations, color, &isOccluder))
    }
    isOccluder.blocks = try control.parallelMap(draining: &isOccluder.blocks) { index, marks in
      addOutliers(in: views.blocks[index], deviations.blocks[index], to: &marks)
      return marks
    }
    var isOutlier = isOccluder
    for occluder in occluderRegions { grow(occluder, views, neighbors, &isOutlier) }
    isOutlier.blocks = try control.parallelMap(draining: &isOutlier.blocks) {
      [isOccluder] index, marks in
      let block = views.blocks[index]
      for face in 0..<block.faceCount {
        let range = block.range(of: face)
        guard range.allSatisfy({ marks[$0] }) else { continue }
        for entry in range { marks[entry] = isOccluder.blocks[index][entry] }
      }
      return marks
    }
    return isOutlier
  }

  /// The deviations of a block's entries.
  private func deviations(in block: FaceViews.Block) -> [Deviation] {
    var result = [Deviation](repeating: .small, count: block.entries.count)
    var scratch: [Float] = []
    for face in 0..<block.faceCount {
      rate(block.range(of: face), in: block, &result, &scratch)
    }
    return result
  }

  /// Marks the outliers among the views that show no known occluder: two occluders can outvote the
  /// surface of a triangle.
  private func addOutliers(
    in block: FaceViews.Block, _ deviations: [Deviation], to isOccluder: inout [Bool]
  ) {
    var deviations = deviations
    var scratch: [Float] = []
    for face in 0..<block.faceCount {
      let range = block.range(of: face)
      if range.contains(where: { isOccluder[$0] }) {
        let entries = range.filter { !isOccluder[$0] }
        for entry in entries { deviations[entry] = .small }
        rate(entries, in: block, &deviations, &scratch)
        for entry in entries where deviations[entry] == .outlier { isOccluder[entry] = true }
      } else {
        for entry in range where deviations[entry] == .outlier { isOccluder[entry] = true }
      }
    }
  }

  /// Determines how far views of one triangle deviate from their median color, relative to the
  /// tolerance. With two views neither is an outlier, but their difference is rated.
  private func rate(
    _ entries: some Collection<Int>, in block: FaceViews.Block,
    _ deviations: inout [Deviation], _ scratch: inout [Float]
  ) {
    let tolerance = SIMD3<Float>(repeating: options.colorTolerance)
    if entries.count == 2 {
      let colors = entries.map { block.entries[$0].color }
      let difference = colors[0] - colors[1]
      guard Self.largest(difference / tolerance) > options.lowThresholdShare else { return }
      for entry in entries { deviations[entry] = .elevated }
    } else if entries.count >= options.minimumViews {
      let median = Self.median(entries, &scratch) { block.entries[$0].color }
      let deviation = Self.median(entries, &scratch) {
        let difference = block.entries[$0].color - median
        return pointwiseMax(difference, -difference)
      }
      let limit = pointwiseMax(deviation * (1.4826 * options.deviations), tolerance)
      for entry in entries {
        let share = Self.largest((block.entries[entry].color - median) / limit)
        deviations[entry] =
          share > 1 ? .outlier : share > options.lowThresholdShare ? .elevated : .small
      }
    }
  }

  /// The median of each channel; `scratch` holds one channel at a time.
  private static func median<Element>(
    _ elements: some Collection<Element>, _ scratch: inout [Float],
    _ color: (Element) -> SIMD3<Float>
  ) -> SIMD3<Float> {
    var median = SIMD3<Float>.zero
    for channel in 0..<3 {
      scratch.removeAll(keepingCapacity: true)
      for element in elements { scratch.append(color(element)[channel]) }
      median[channel] = scratch.sortedUpperMedian() ?? 0
    }
    return median
  }

  private static func largest(_ v: SIMD3<Float>) -> Float { pointwiseMax(v, -v).max() }

  /// Regions of connected entries of one view above the low threshold that contain a sufficient
  /// area above the high one.
  private func occluders(
    _ deviations: EntryValues<Deviation>, _ views: FaceViews, _ neighbors: FaceNeighbors
  ) -> [[Index]] {
    var isVisited = EntryValues(repeating: false, for: views)
    var occluders: [[Index]] = []
    for (block, list) in deviations.blocks.enumerated() {
      for (entry, deviation) in list.enumerated() where deviation == .outlier {
        let seed = Index(block: Int32(block), entry: Int32(entry))
        guard !isVisited[seed] else { continue }
        isVisited[seed] = true
        let group = neighbors.flood(from: [seed], in: views) { other in
          guard !isVisited[other], deviations[other] != .small, hasEnoughViews(other, views)
          else { return false }
          isVisited[other] = true
          return true
        }
        let area = group.reduce(Float(0)) {
          $0 + (deviations[$1] == .outlier ? views[$1].area : 0)
        }
        if area >= options.minimumRegionPixels { occluders.append(group) }
      }
    }
    return occluders
  }

  /// Whether enough views see the entry's triangle for a meaningful median.
  private func hasEnoughViews(_ entry: Index, _ views: FaceViews) -> Bool {
    viewCount(entry, views) >= options.minimumViews
  }

  /// The number of views that see the entry's triangle.
  private func viewCount(_ entry: Index, _ views: FaceViews) -> Int {
    views.entries(of: Int(views[entry].face)).count
  }

  /// Grows an occluder region by color over triangles that too few views see, or that other
  /// occluders also hide. Returns the whole region.
  private func extend(
    _ occluder: [Index], over views: FaceViews, _ neighbors: FaceNeighbors,
    _ deviations: EntryValues<Deviation>, _ occluderColor: OccluderColor,
    _ isOccluder: inout EntryValues<Bool>
  ) -> [Index] {
    neighbors.flood(from: occluder, in: views) { other in
      guard !isOccluder[other] else { return false }
      let isAlone = viewCount(other, views) == 1
      let mayDiffer =
        !hasEnoughViews(other, views) && (isAlone || deviations[other] != .small)
      let share = occluderColor.share(of: views[other].color)
      guard share > (mayDiffer ? options.unverifiedColorSimilarity : options.colorSimilarity) else {
        return false
      }
      isOccluder[other] = true
      return true
    }
  }

  /// Marks the rings of triangles around an occluder region.
  private func grow(
    _ occluder: [Index], _ views: FaceViews, _ neighbors: FaceNeighbors,
    _ isOutlier: inout EntryValues<Bool>
  ) {
    var front = occluder
    for _ in 0..<options.rings {
      var next: [Index] = []
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

  /// The color of an occluder with the given entries, and of the surface behind it.
  private func occluderColor(_ entries: [Index], _ views: FaceViews) -> OccluderColor {
    var color = OccluderColor()
    var scratch: [Float] = []
    let share = 1 / Float(max(1, entries.count))
    for entry in entries {
      let observation = views[entry]
      color.occluder += observation.color * share
      color.surface +=
        Self.median(views.entries(of: Int(observation.face)), &scratch, \.color) * share
    }
    return color
  }

  /// The mean color of an occluder and of the surface behind it.
  private struct OccluderColor {
    var occluder = SIMD3<Float>.zero
    var surface = SIMD3<Float>.zero

    /// Position of a color on the line from the surface's color, 0, to the occluder's, 1.
    func share(of color: SIMD3<Float>) -> Float {
      let direction = occluder - surface
      return (color - surface).dot(direction) / max(direction.squaredLength, 1e-6)
    }
  }
}
