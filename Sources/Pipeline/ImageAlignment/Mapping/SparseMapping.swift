import Kernels
import SceneModel

/// From verified pairs to cameras, poses and points.
package struct SparseMapping: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    package var method = MappingMethod.automatic
    package var incremental = IncrementalMapping.Options()
    package var global = GlobalMapping.Options()
    /// Minimum fraction of the largest connected group that global mapping must register for the
    /// automatic method to use it. Chosen.
    package var minimumShare = 0.8
    /// Minimum fraction that its start must register: the rest is registered one photo at a time,
    /// and a start that many pairs agree on is better than one of two photos. Chosen. Measured:
    /// starts with 0.74 of 250 photos of a town (`town 250 1 800`) and 0.5 of dinoRing grew to maps
    /// of all; without them, the town was folded, and dinoRing's rotations were 2.1° off instead of
    /// 0.7°. templeSparse is the same with a start of 0.25.
    package var minimumStartShare = 0.25
    /// Minimum fraction of the triplets of pairs whose rotations must compose to the identity for
    /// global mapping to be the first choice. Two photos of a plane, or of a small patch, don't
    /// determine their relative rotation; incremental mapping doesn't need it. Chosen: the
    /// majority (docs/experiments/2026-11-planes.md).
    package var minimumConsistentShare = 0.5

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the largest reconstruction of the view graph, in the frame of one of its photos;
  /// `unregistered` gives the reasons why photos are missing.
  package func run(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], cameras: [Camera],
    _ context: StageContext
  ) throws -> Reconstruction {
    try map(graph, features: features, photos: photos, cameras: cameras, context).reconstruction
  }

  /// Whether the relative rotations of the pairs agree well enough for global mapping to be the
  /// first choice.
  func rotationsAgree(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], cameras: [Camera],
    _ context: StageContext
  ) throws -> Bool {
    let share = try GlobalMapping(options.global, growth: options.incremental)
      .consistentTripletShare(
        graph, features, PosedPhotos(cameras: cameras, unposed: photos),
        context.part(from: 0, to: 0))
    context.notes.record("consistentTripletShare", share)
    return share >= options.minimumConsistentShare
  }

  /// Whether a reconstruction has most photos of the largest connected group.
  func isLarge(_ reconstruction: Reconstruction, of graph: ViewGraph) -> Bool {
    isLarge(reconstruction.registered.count, of: graph, share: options.minimumShare)
  }

  private func isLarge(_ photos: Int, of graph: ViewGraph, share: Double) -> Bool {
    Double(photos) >= share * Double(graph.connectedGroups.first?.count ?? 0)
  }

  /// The same as `run`, with the method that it was made by, `global` or `incremental`.
  func map(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], cameras: [Camera],
    _ context: StageContext
  ) throws -> (reconstruction: Reconstruction, method: MappingMethod) {
    let tracks = try TrackBuilding().run(graph, features: features, context.part(from: 0, to: 0.1))
    let empty = SparseMap(cameras: cameras, photos: photos, tracks: tracks)
    let start =
      options.method == .incremental
      ? nil
      : try GlobalMapping(options.global, growth: options.incremental)
        .start(graph, features: features, empty, context.part(from: 0.1, to: 0.4))
    func grown(from start: SparseMap?) throws -> (
      reconstruction: Reconstruction, method: MappingMethod
    ) {
      context.notes.record("globalPhotos", Double(start?.registered.count ?? 0))
      let result = try IncrementalMapping(options.incremental).run(
        graph, features: features, photos: photos, empty: empty, from: start,
        context.part(from: start == nil ? 0.1 : 0.4, to: 1))
      return (result, start == nil ? .incremental : .global)
    }
    guard options.method == .automatic, let start else { return try grown(from: start) }

    guard isLarge(start.registered.count, of: graph, share: options.minimumStartShare) else {
      return try grown(from: nil)
    }
    let result = try grown(from: start)
    if isLarge(result.reconstruction, of: graph) { return result }
    let other = try grown(from: nil)
    let (count, otherCount) = (
      result.reconstruction.registered.count, other.reconstruction.registered.count
    )
    return otherCount > count ? other : result
  }
}
