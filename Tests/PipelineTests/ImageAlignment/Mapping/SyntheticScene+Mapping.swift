import Kernels
import Pipeline
import SceneModel
import TestSupport

extension SyntheticScene {
  /// A map of the scene that begins with cameras without distortion; of all its pairs unless others
  /// are given.
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

  /// The pairs without one photo.
  func pairs(without photo: Int) -> [VerifiedPair] {
    viewGraph.pairs.filter { $0.pair.first.index != photo && $0.pair.second.index != photo }
  }

  /// How far the poses of a map are from the true ones.
  func comparison(_ map: Reconstruction) -> PoseComparison {
    PoseComparison(estimated: map.poses, true: poses)
  }
}

extension SyntheticScene.Options {
  /// A scene of noise and wrong matches, of a size that fits the layout.
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
