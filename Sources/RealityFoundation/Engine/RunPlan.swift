import Pipeline
import SceneModel

/// The requests of a run in the order that they are worked on, and what each needs.
///
/// What needs least comes first, then models from coarse to fine.
struct RunPlan: Sendable {
  /// A request and what has to be done for it.
  struct Entry: Sendable {
    var request: PhotogrammetrySession.Request
    /// In the order of the stages.
    var units: [WorkUnit]
    /// What the model is to be like; nil where no model is asked for.
    var specification: DetailSpecification?
  }

  let entries: [Entry]
  /// The requests as they were given, without repetitions.
  let requests: [PhotogrammetrySession.Request]
  /// What the shared stages are done for: the finest of all levels.
  let finest: DetailSpecification

  init(
    _ requests: [PhotogrammetrySession.Request],
    configuration: PhotogrammetrySession.Configuration
  ) {
    var seen: Set<PhotogrammetrySession.Request> = []
    self.requests = requests.filter { seen.insert($0).inserted }
    let specifications = self.requests.compactMap { $0.specification(configuration) }
    let models = specifications.sorted { $0.viewPixels < $1.viewPixels }
    let coarsest = models.first ?? DetailSpecification(.preview)
    finest =
      models.last ?? DetailSpecification(self.requests.contains(.pointCloud) ? .reduced : .preview)
    entries = self.requests
      .map {
        Entry($0, specification: $0.specification(configuration), coarsest: coarsest)
      }
      .enumerated()
      .sorted { ($0.element.rank, $0.offset) < ($1.element.rank, $1.offset) }
      .map(\.element)
  }

  /// What the models are to be like, and the finest of all.
  var specifications: [DetailSpecification] {
    entries.compactMap(\.specification) + (requests.contains(.pointCloud) ? [finest] : [])
  }

  /// All units in the order that they are worked on.
  var units: [WorkUnit] {
    var seen: Set<WorkUnit> = []
    return entries.flatMap(\.units).filter { seen.insert($0).inserted }
  }
}

extension RunPlan.Entry {
  fileprivate init(
    _ request: PhotogrammetrySession.Request, specification: DetailSpecification?,
    coarsest: DetailSpecification
  ) {
    self.request = request
    self.specification = specification
    let last: PipelineStage =
      switch request {
      case .poses: .imageAlignment
      case .pointCloud: .pointCloudGeneration
      case .bounds: .meshGeneration
      case .modelEntity: .textureMapping
      case .modelFile: .optimization
      }
    if request == .bounds { self.specification = coarsest }
    let stages = PipelineStage.allCases
    units = stages.prefix(through: stages.firstIndex(of: last) ?? 0)
      .map { [specification = self.specification] in
        WorkUnit(stage: $0, specification: specification)
      }
  }

  /// Sorts by how much of the pipeline is needed, then by how fine it is to be.
  fileprivate var rank: Int {
    switch request {
    case .poses, .pointCloud, .bounds: units.count
    case .modelFile, .modelEntity: units.count + (specification?.viewPixels ?? 0)
    }
  }
}

extension PhotogrammetrySession.Request {
  /// The budgets of the requested model; nil where none is requested.
  fileprivate func specification(
    _ configuration: PhotogrammetrySession.Configuration
  ) -> DetailSpecification? {
    switch self {
    case .modelFile(_, let detail, _), .modelEntity(let detail, _):
      DetailSpecification(detail, custom: configuration.customDetailSpecification)
    case .bounds, .pointCloud, .poses: nil
    }
  }
}
