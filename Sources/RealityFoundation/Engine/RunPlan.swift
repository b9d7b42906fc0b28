import Pipeline
import SceneModel

/// The requests of a run in the order of processing, and the work that each needs.
///
/// Requests that need the least work come first, then models from coarse to fine.
struct RunPlan: Sendable {
  /// A request and the work that it needs.
  struct Entry: Sendable {
    var request: PhotogrammetrySession.Request
    /// In the order of the stages.
    var units: [WorkUnit]
    /// Its units and those of all entries before it, in the order of work: what is to be done until
    /// it is complete.
    var work: [WorkUnit] = []
    /// The budgets of the model; nil if no model is requested.
    var specification: DetailSpecification?
  }

  let entries: [Entry]
  /// The requests in the given order, without duplicates.
  let requests: [PhotogrammetrySession.Request]
  /// The specification that shared stages work for: the finest of all.
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
    var entries = self.requests
      .map {
        Entry(
          $0, specification: $0.specification(configuration), coarsest: coarsest)
      }
      .enumerated()
      .sorted { ($0.element.rank, $0.offset) < ($1.element.rank, $1.offset) }
      .map(\.element)
    var work: [WorkUnit] = []
    for index in entries.indices {
      work += entries[index].units.filter { !work.contains($0) }
      entries[index].work = work
    }
    self.entries = entries
  }

  /// The request of the model file that is made last: the finest one.
  var lastFile: PhotogrammetrySession.Request? {
    entries.last { if case .modelFile = $0.request { true } else { false } }?.request
  }

  /// The budgets of all models, and the finest ones for a point cloud.
  var specifications: [DetailSpecification] {
    entries.compactMap(\.specification) + (requests.contains(.pointCloud) ? [finest] : [])
  }

  /// All units in the order of processing.
  var units: [WorkUnit] { entries.last?.work ?? [] }
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

  /// Orders requests by the number of stages that they need, then by view resolution.
  fileprivate var rank: Int {
    switch request {
    case .poses, .pointCloud, .bounds: units.count
    case .modelFile, .modelEntity: units.count + (specification?.viewPixels ?? 0)
    }
  }
}

extension PhotogrammetrySession.Request {
  /// The budgets of the requested model; nil if none is requested.
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
