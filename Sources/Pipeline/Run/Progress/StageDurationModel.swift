import Foundation

/// Expected durations of the stages of a run, before anything is measured.
///
/// Fitted to ten runs with two threads and 8 to 40 photos of 0.5 to 6 megapixels, at all detail
/// levels from preview to full; meshing scaled to boot, orbit and saharov32 at reduced and boot at
/// medium since its solver uses all threads. Those of meshing and texture mapping hold for two
/// threads.
package struct StageDurationModel: Sendable {
  /// The work that yields cameras and sparse points.
  package enum AlignmentWork: Sendable {
    /// Structure from motion.
    case search
    /// Cameras are given; points are triangulated from matches.
    case triangulation
    /// Cameras and points are given.
    case none
  }

  /// The photos of the run.
  package var photos: PhotoTotals
  /// The specification for stages that all models share.
  package var finest: DetailSpecification
  package var threadCount: Int
  package var alignment: AlignmentWork
  /// The fraction of the views that the dense stage processes: less than 1 for one of several jobs.
  package var denseShare: Double
  /// Whether masks of the object are estimated if none are given; otherwise those of the sky.
  package var masksObject: Bool
  /// Whether the scene is written in tiles, too.
  package var makesTiles: Bool

  package init(
    photos: PhotoTotals, finest: DetailSpecification, threadCount: Int,
    alignment: AlignmentWork = .search, denseShare: Double = 1, masksObject: Bool = true,
    makesTiles: Bool = false
  ) {
    (self.photos, self.finest, self.threadCount) = (photos, finest, threadCount)
    (self.alignment, self.denseShare) = (alignment, denseShare)
    (self.masksObject, self.makesTiles) = (masksObject, makesTiles)
  }

  /// Expected seconds of a model, from the photos to the file.
  package var total: Double { seconds(of: PipelineStage.allCases) }

  /// Expected seconds of several stages together.
  package func seconds(of stages: [PipelineStage]) -> Double {
    stages.reduce(0) { $0 + seconds(of: WorkUnit(stage: $1)) }
  }

  /// Expected seconds of a unit of work.
  package func seconds(of unit: WorkUnit) -> Double {
    let specification = unit.specification ?? finest
    let (count, megapixels) = (Double(max(1, photos.count)), max(0.1, photos.megapixels))
    // Neither a view nor a texture has more pixels than the photos.
    let view = min(Double(specification.viewPixels) / 1e6, megapixels / count)
    let side = Double(specification.textureSide)
    let texels = min(side * side / 1e6, 0.45 * megapixels)
    let threads = Double(max(1, threadCount))
    return switch unit.stage {
    case .preProcessing: (0.01 * count + 0.015 * megapixels) / threads
    case .imageAlignment: alignmentSeconds(count, megapixels) / threads
    case .objectMasking: photos.masked > 0 ? 0 : maskingSeconds(count) / threads
    case .pointCloudGeneration: 0.4 + 1.84 * denseShare * count * view / threads
    // The octree usually has the same depth for 0.2 MP and 0.5 MP, and is shallower below 0.12 MP.
    case .meshGeneration: view < 0.12 ? 1.5 : 5.2 * pow(view / 0.5, view < 0.5 ? 0.27 : 0.45)
    case .textureMapping: 0.025 * megapixels + 0.42 * texels + 11.8 * view.squareRoot()
    case .optimization:
      0.1 + 0.06 * texels + (makesTiles && specification == finest ? tileSeconds(count * view) : 0)
    }
  }

  /// Measured: on the town of 100 photos at reduced, with two threads.
  private func tileSeconds(_ viewMegapixels: Double) -> Double { 12 * viewMegapixels }

  /// Seconds on a single thread, of the object's masks or of those of the sky.
  private func maskingSeconds(_ count: Double) -> Double {
    masksObject ? 0.3 + 0.2 * count : 0.1 * count
  }

  /// Seconds on a single thread. Features and matches take two fifths of structure from motion, as
  /// measured in runs of 11, 32 and 40 photos.
  private func alignmentSeconds(_ count: Double, _ megapixels: Double) -> Double {
    let pairs = min(count * (count - 1) / 2, count * 20)
    let search = 0.4 * count + 0.09 * megapixels + 0.005 * pairs
    return switch alignment {
    case .search: search
    case .triangulation: 0.4 * search
    case .none: 0.002 * count
    }
  }
}
