import Kernels
import SceneModel

/// Mapping scenes in which a pattern repeats.
extension ImageAlignment {
  struct RepetitionOptions: Hashable, Codable, Sendable {
    var features = RepetitiveFeatures.Options()
    /// Minimum number of observations of what the photos are aimed at, as a share of those with
    /// repetitive features. Measured: 0.16 for a loudspeaker whose grille repeats (`loudspeaker 2
    /// still`), 0.95 for statues in front of wallpaper (seeds 2 and 23).
    var minimumFocusShare = 0.5
    /// Duration of the alignment with a second map, relative to that with one. Measured: 1.37 to
    /// 1.70, median 1.59, on five rendered wallpapers (seeds 1, 2, 3, 21 and 22).
    var relativeDuration = 1.6

    init() {}
  }

  /// Matched photos and their map.
  struct MappedPhotos: Sendable {
    var matched: MatchedPhotos
    var map: Map
  }

  /// Matches and maps photos again without repetitive features, if a map with them may superimpose
  /// parts of the scene, and takes the new map if it is consistent and still shows what the photos
  /// are aimed at: its own texture may repeat, such as the grille of a loudspeaker.
  ///
  /// `context` is that of the whole stage, of which the fraction `done` is done. Also returns the
  /// context of the rest, which takes longer then than was expected; nil if nothing was tried.
  func resolveRepetition(
    of mapped: MappedPhotos, _ images: ImageStore, _ context: StageContext, after done: Double
  ) throws -> (mapped: MappedPhotos, rest: StageContext?) {
    guard mapped.map.mayBeWrong,
      let kept = try RepetitiveFeatures(options: options.repetition.features).distinctiveFeatures(
        mapped.matched.graph, mapped.matched.features, context.control.part(from: done, to: done))
    else { return (mapped, nil) }
    let rest = context.extended(by: options.repetition.relativeDuration, after: done)
    let attempt = StageContext(control: rest.control.part(from: 0, to: 0.7))
    let end = rest.part(from: 0.7, to: 1)
    guard let found = try mapByDistinctiveFeatures(kept, mapped.matched, images, attempt),
      found.map.replaces(mapped.map, minimumShare: options.replacingShare),
      FocusCheck().isKept(
        from: mapped.map.reconstruction, in: found.map.reconstruction, mapped.matched.features,
        minimumShare: options.repetition.minimumFocusShare)
    else {
      context.notes.log(
        "A pattern repeats in the scene, but features that don't repeat do not align the photos.")
      return (mapped, end)
    }
    context.notes.add(attempt.notes)
    context.notes.log(
      "A pattern repeats in the scene: the photos were aligned by features that don't repeat.")
    return (found, end)
  }

  /// Nil if there is no such map.
  private func mapByDistinctiveFeatures(
    _ kept: [[Int]], _ matched: MatchedPhotos, _ images: ImageStore, _ context: StageContext
  ) throws -> MappedPhotos? {
    do {
      let distinctive = try match(
        matched, byFeatures: kept, options.search, context.part(from: 0, to: 0.6))
      let map = try forAlternatives.map(
        distinctive, images: images, context.part(from: 0.6, to: 1))
      return MappedPhotos(matched: distinctive, map: map)
    } catch is PipelineError {
      return nil
    }
  }

  /// The photos matched again by some of their features.
  func match(
    _ matched: MatchedPhotos, byFeatures kept: [[Int]], _ search: CorrespondenceSearch.Options,
    _ context: StageContext
  ) throws -> MatchedPhotos {
    let (graph, cameras) = try CorrespondenceSearch(search).run(
      photos: matched.photos, cameras: matched.cameras,
      features: zip(matched.features, kept).map { $0.selecting($1) }, ordering: options.ordering,
      context)
    var result = matched
    result.graph = graph.renumbered(kept, featureCounts: matched.features.map(\.count))
    result.cameras = cameras
    return result
  }
}
