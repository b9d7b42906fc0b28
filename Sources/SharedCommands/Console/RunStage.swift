/// The stages of a run as `--json` names them.
package enum RunStage: String, CaseIterable, Codable, Sendable {
  /// Photos are made of a video, before the run.
  case frameSelection
  case preProcessing, imageAlignment, pointCloudGeneration, meshGeneration, textureMapping
  case optimization
  /// Triangulation of points with known cameras.
  case triangulation

  /// The stage in progress lines.
  var title: String {
    switch self {
    case .frameSelection: "choosing frames"
    case .preProcessing: "reading photos"
    case .imageAlignment: "aligning photos"
    case .pointCloudGeneration: "generating points"
    case .meshGeneration: "generating mesh"
    case .textureMapping: "mapping texture"
    case .optimization: "writing model"
    case .triangulation: "triangulating points"
    }
  }
}
