import Kernels
@testable import Pipeline
import SceneModel
import TestSupport

extension SyntheticScene {
  /// Maps the scene from all its pairs or the given ones, starting with cameras without distortion.
  func mapped(
    _ method: MappingMethod, graph: ViewGraph? = nil, focalFactor: Double = 1,
    notes: StageNotes = StageNotes(), control: KernelControl = KernelControl()
  ) throws -> Reconstruction {
    var options = SparseMapping.Options()
    options.method = method
    var camera = camera
    camera.focalLength *= focalFactor
    camera.distortion = .zero
    return try SparseMapping(options).run(
      graph ?? viewGraph, features: features, photos: photos, cameras: [camera],
      StageContext(control: control, notes: notes))
  }

  /// Whether global mapping is the first choice for the given pairs.
  func rotationsAgree(_ graph: ViewGraph, notes: StageNotes = StageNotes()) throws -> Bool {
    try SparseMapping().rotationsAgree(
      graph, features: features, photos: photos, cameras: [camera], StageContext(notes: notes))
  }

  /// The pairs that don't contain the given photo.
  func pairs(without photo: Int) -> [VerifiedPair] {
    viewGraph.pairs.filter { $0.pair.first.index != photo && $0.pair.second.index != photo }
  }

  /// Errors of the poses of a map.
  func comparison(_ map: Reconstruction) -> PoseComparison {
    PoseComparison(estimated: map.poses, true: poses)
  }
}

extension SyntheticScene.Options {
  /// A scene with noise and wrong matches, of a size suitable for the layout.
  static func noisy(_ layout: SyntheticScene.Layout, outliers: Double) -> Self {
    var options = Self()
    options.layout = layout
    options.photoCount = layout == .ring ? 16 : 10
    options.pixelNoise = 0.3
    options.outlierRatio = outliers
    options.relativePoseNoise = 0.01
    return options
  }
}
