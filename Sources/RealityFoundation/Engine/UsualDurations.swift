import Pipeline

/// How long units of work usually take: where an estimate begins.
///
/// Measured on photos of 2 to 12 megapixels with two threads.
struct UsualDurations: Sendable {
  var photoCount: Int
  /// What the shared stages are done for.
  var finest: DetailSpecification
  var threadCount: Int

  /// Seconds that a unit usually takes.
  func seconds(of unit: WorkUnit) -> Double {
    let photos = Double(max(1, photoCount))
    let pixels = Double((unit.specification ?? finest).viewPixels) / 500_000
    let texels = Double((unit.specification ?? finest).textureSide) / 2048
    let pairs = min(photos * (photos - 1) / 2, photos * 20)
    let seconds =
      switch unit.stage {
      case .preProcessing: 0.15 * photos
      case .imageAlignment: 1.5 * photos + 0.1 * pairs
      case .pointCloudGeneration: 4 * photos * pixels
      case .meshGeneration: 5 + 15 * pixels
      case .textureMapping: 5 + 0.5 * photos + 10 * texels * texels
      case .optimization: 0.5 + 2 * texels * texels
      }
    return seconds * 2 / Double(max(1, threadCount))
  }
}
