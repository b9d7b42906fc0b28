import Pipeline

/// How long units of work usually take: where an estimate begins.
///
/// Fitted to ten runs on two threads, from 8 to 40 photos of 0.5 to 6 megapixels, at all levels from
/// preview to full. Meshes and textures take one thread for the most part.
package struct UsualDurations: Sendable {
  /// The photos that are used.
  package struct Photos: Hashable, Sendable {
    package var count: Int
    /// Of all of them.
    package var megapixels: Double

    package init(count: Int, megapixels: Double) {
      (self.count, self.megapixels) = (count, megapixels)
    }

    /// So many photos of a size that is common.
    package init(count: Int) { self.init(count: count, megapixels: 6 * Double(count)) }
  }

  var photos: Photos
  /// What the shared stages are done for.
  var finest: DetailSpecification
  var threadCount: Int

  package init(photos: Photos, finest: DetailSpecification, threadCount: Int) {
    (self.photos, self.finest, self.threadCount) = (photos, finest, threadCount)
  }

  /// Seconds that a model usually takes, from the photos on.
  package var total: Double {
    PipelineStage.allCases.reduce(0) { $0 + seconds(of: WorkUnit(stage: $1)) }
  }

  /// Seconds that a unit usually takes.
  func seconds(of unit: WorkUnit) -> Double {
    let specification = unit.specification ?? finest
    let (count, megapixels) = (Double(max(1, photos.count)), max(0.1, photos.megapixels))
    // Neither a view nor a texture has more pixels than there are.
    let view = min(Double(specification.viewPixels) / 1e6, megapixels / count)
    let side = Double(specification.textureSide)
    let texels = min(side * side / 1e6, 0.45 * megapixels)
    let pairs = min(count * (count - 1) / 2, count * 20)
    let threads = Double(max(1, threadCount))
    return switch unit.stage {
    case .preProcessing: (0.01 * count + 0.015 * megapixels) / threads
    case .imageAlignment: (0.4 * count + 0.09 * megapixels + 0.005 * pairs) / threads
    case .pointCloudGeneration: 0.4 + 1.84 * count * view / threads
    // The octree is mostly as deep for a fifth of a megapixel as for half of one, and shallower below.
    case .meshGeneration: view < 0.12 ? 4.2 : 14.5 * pow(view / 0.5, view < 0.5 ? 0.27 : 0.45)
    case .textureMapping: 0.025 * megapixels + 0.42 * texels + 11.8 * view.squareRoot()
    case .optimization: 0.1 + 0.06 * texels
    }
  }
}
