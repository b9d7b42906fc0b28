import Kernels
import SceneModel

/// Divides photos into groups between which the object was moved, for instance laid on another
/// side.
///
/// The links between photos are for and against two photos showing the object in the same
/// placement. Photos are usually in the order of capture, and then placements are intervals, which
/// dynamic programming finds. Otherwise greedy edge contraction divides the signed graph (Keuper et
/// al., "Efficient decomposition of image and mesh graphs by lifted multicuts", ICCV 2015).
///
/// A placement needs links that contradict one rigid scene. Photos that are merely not linked to
/// the others, because they show something else or overlap too little, are none.
struct PlacementDetection: Sendable {
  struct Options: Hashable, Codable, Sendable {
    var intervals = CaptureIntervals.Options()
    /// Weight of a point that is missing in a photo, relative to one that is there: of the points
    /// that the map predicts, up to a sixth are not found even if nothing moved. Chosen.
    var absenceWeight = 4

    init() {}
  }

  typealias Link = PlacementLink

  var options = Options()

  /// The groups by the pairs of a graph that show two motions; nil if the object was not moved a
  /// few times only, but between most photos.
  func groups(_ graph: ViewGraph, _ control: KernelControl = KernelControl()) throws
    -> Placements?
  {
    try intervals(links(of: graph.motions), photoCount: graph.photoCount, control).map {
      Placements(groups: $0, basis: .order)
    }
  }

  /// Two motions contradict the same placement.
  func links(of motions: [TwoMotions]) -> [PhotoPair: Link] {
    var links: [PhotoPair: Link] = [:]
    for motion in motions {
      links[motion.pair] = Link(agreement: -(motion.bodies.map(\.matches.count).min() ?? 0))
    }
    return links
  }

  /// The groups, each in ascending order, larger ones first; one group if the object did not move.
  func groups(
    _ links: [PhotoPair: Link], photoCount: Int, _ control: KernelControl = KernelControl()
  ) throws -> Placements {
    guard links.values.contains(where: { $0.agreement < 0 }) else {
      return Placements(groups: [Array(0..<photoCount)], basis: .none)
    }
    if let found = try intervals(links, photoCount: photoCount, control) {
      return Placements(groups: found, basis: .order)
    }
    let found = try contracted(links, photoCount: photoCount, control)
    return Placements(groups: found, basis: found.count > 1 ? .links : .none)
  }

  /// The division of the order of capture; nil if it does not explain the links.
  private func intervals(
    _ links: [PhotoPair: Link], photoCount: Int, _ control: KernelControl
  ) throws -> [[Int]]? {
    try CaptureIntervals(
      links.mapValues(\.agreement), photoCount: photoCount, options: options.intervals
    ).division(control)
  }

  /// The groups of photos that remain after contracting links: first by agreement, then, between
  /// photos that are nowhere near each other in the map, by matches.
  private func contracted(
    _ links: [PhotoPair: Link], photoCount: Int, _ control: KernelControl
  ) throws -> [[Int]] {
    var contraction = LinkContraction(links, photoCount: photoCount)
    try contraction.run(control) { $0.agreement }
    try contraction.run(control) { $0.agreement < 0 ? 0 : $0.matches }
    let groups = contraction.groups.filter { $0.count >= options.intervals.minimumPhotos }
    let placements = contradicted(groups, links, photoCount: photoCount)
    guard placements.count < 2 else { return placements }
    return groups.max { ($0.count, $1[0]) < ($1.count, $0[0]) }.map { [$0] } ?? []
  }

  /// The groups of which several photos contradict photos of another one.
  private func contradicted(
    _ groups: [[Int]], _ links: [PhotoPair: Link], photoCount: Int
  ) -> [[Int]] {
    var groupOf = [Int?](repeating: nil, count: photoCount)
    for (number, group) in groups.enumerated() { for photo in group { groupOf[photo] = number } }
    var agreement = [Int](repeating: 0, count: photoCount)
    for (pair, link) in links {
      let (first, second) = (pair.first.index, pair.second.index)
      guard let group = groupOf[first], let other = groupOf[second], group != other else {
        continue
      }
      agreement[first] += link.agreement
      agreement[second] += link.agreement
    }
    return groups.filter { group in
      group.count { agreement[$0] < 0 } >= options.intervals.minimumBoundarySupport
    }
  }
}
