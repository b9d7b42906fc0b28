import ArgumentParser
import Pipeline

/// A step of the dense stage that `densify --without` omits, to measure what it contributes.
enum Ablation: String, CaseIterable, ExpressibleByArgument {
  case completion
  case expansionAcrossViews = "expansion-across-views"
  case normals
  case filter
  case coarseToFine = "coarse-to-fine"

  func apply(to options: inout PointCloudGeneration.Options) {
    switch self {
    case .completion: options.completes = false
    case .expansionAcrossViews: options.patches.expandsAcrossViews = false
    case .normals: options.patches.estimatesNormals = false
    case .coarseToFine: options.patches.levelCount = 1
    case .filter:
      options.filter.minimumAgreeingViews = 0
      options.filter.contradictionThreshold = 1e9
      options.filter.depthEdgePasses = 0
      options.filter.minimumIsland = 0
    }
  }
}
