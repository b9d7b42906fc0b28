import Pipeline
import RealityFoundation
import SharedCommands

extension DetailArguments {
  /// The limits of the model.
  var limits: DetailSpecification {
    DetailSpecification(detail.requestDetail, custom: specification)
  }
}

extension DetailArgument {
  /// The limits of a level.
  var limits: DetailSpecification { DetailSpecification(requestDetail, custom: .init()) }
}

extension DetailChoice {
  /// The usual upper bound of a run's memory in bytes: twice that of runs with about 50 photos.
  var expectedMemoryBytes: Int {
    switch self {
    case .level(.preview), .level(.reduced): Machine.neededMemoryBytes
    case .level(.medium), .custom: 3 << 30
    case .level(.full): 4 << 30
    case .level(.raw): 8 << 30
    }
  }
}
