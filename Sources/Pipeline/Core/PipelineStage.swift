/// The stages of a run in their order: the cases of `Output.ProcessingStage`, and object masking,
/// which is reported as a part of point cloud generation.
package enum PipelineStage: String, CaseIterable, Codable, Sendable {
  case preProcessing, imageAlignment, objectMasking, pointCloudGeneration, meshGeneration
  case textureMapping, optimization
}
