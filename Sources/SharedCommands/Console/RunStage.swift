/// The stages of a run as `--json` names them.
package enum RunStage: String, CaseIterable, Codable, Sendable {
  case preProcessing, imageAlignment, pointCloudGeneration, meshGeneration, textureMapping
  case optimization
  /// Triangulation of points with known cameras.
  case triangulation

  /// The stage in progress lines.
  var title: String {
    switch self {
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
