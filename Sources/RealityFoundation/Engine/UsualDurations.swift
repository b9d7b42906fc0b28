import Pipeline

/// How long units of work usually take: where an estimate begins.
///
/// Fitted to runs on photos of 0.5 and 0.8 megapixels. Meshes and textures take one thread for the
/// most part.
package struct UsualDurations: Sendable {
  var photoCount: Int
  /// What the shared stages are done for.
  var finest: DetailSpecification
  var threadCount: Int

  package init(photoCount: Int, finest: DetailSpecification, threadCount: Int) {
    (self.photoCount, self.finest, self.threadCount) = (photoCount, finest, threadCount)
  }

  /// Seconds that a model usually takes, from the photos on.
  package var total: Double {
    PipelineStage.allCases.reduce(0) { $0 + seconds(of: WorkUnit(stage: $1)) }
  }

  /// Seconds that a unit usually takes.
  func seconds(of unit: WorkUnit) -> Double {
    let photos = Double(max(1, photoCount))
    let pixels = Double((unit.specification ?? finest).viewPixels) / 500_000
    let texels = Double((unit.specification ?? finest).textureSide) / 2048
    let pairs = min(photos * (photos - 1) / 2, photos * 20)
    let threads = Double(max(1, threadCount))
    return switch unit.stage {
    case .preProcessing: 0.03 * photos / threads
    case .imageAlignment: (0.4 * photos + 0.03 * pairs) / threads
    case .pointCloudGeneration: 1.1 * photos * pixels / threads
    case .meshGeneration: 6 + 3 * pixels
    case .textureMapping: 1 + 0.1 * photos + 2 * texels * texels
    case .optimization: 0.3 + 1.4 * texels * texels
    }
  }
}
