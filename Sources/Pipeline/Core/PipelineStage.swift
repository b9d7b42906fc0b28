/// The stages of a run in their order; the cases of `Output.ProcessingStage`.
package enum PipelineStage: String, CaseIterable, Codable, Sendable {
  case preProcessing, imageAlignment, pointCloudGeneration, meshGeneration, textureMapping
  case optimization
}
