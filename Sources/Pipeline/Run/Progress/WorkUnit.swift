/// A unit of work that is done once, regardless of the number of requests that need it.
package struct WorkUnit: Hashable, Sendable {
  package var stage: PipelineStage
  /// The model that the unit is for; nil for stages that all models share.
  package var specification: DetailSpecification?

  // The units that all models share.
  package static let preProcessing = WorkUnit(stage: .preProcessing)
  package static let alignment = WorkUnit(stage: .imageAlignment)
  package static let densification = WorkUnit(stage: .pointCloudGeneration)

  package init(stage: PipelineStage, specification: DetailSpecification? = nil) {
    self.stage = stage
    switch stage {
    case .preProcessing, .imageAlignment, .objectMasking, .pointCloudGeneration, .meshGeneration:
      self.specification = nil
    case .textureMapping, .optimization: self.specification = specification
    }
  }
}
