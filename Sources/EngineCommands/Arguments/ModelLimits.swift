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
  /// Memory that a run usually takes at most, in bytes: twice what runs of some 50 photos took.
  var expectedMemoryBytes: Int {
    switch self {
    case .level(.preview), .level(.reduced): Machine.neededMemoryBytes
    case .level(.medium), .custom: 3 << 30
    case .level(.full): 4 << 30
    case .level(.raw): 8 << 30
    }
  }
}
