import Foundation
import Kernels

/// The part of a configuration that the result of a stage depends on, as bytes.
///
/// This is the whole encoded configuration without the options of later stages and a list of
/// exclusions: a new option counts unless it is listed here.
enum ConfigurationFingerprint {
  /// A member of the encoded configuration, and why no sealed result depends on it.
  struct Exclusion: Sendable {
    var path: [String]
    var reason: String

    init(_ path: String, _ reason: String) {
      self.path = path.split(separator: ".").map(String.init)
      self.reason = reason
    }
  }

  static let exclusions = [
    Exclusion("threadCount", "results do not depend on it"),
    Exclusion("checkpointDirectory", "results do not depend on where they are written"),
    Exclusion("maskOutput", "it receives masks that are used anyway"),
    Exclusion("previewFile", "it shows a finished model"),
    Exclusion("tiles", "they are made besides the model"),
    Exclusion("keepsReportMaterial", "it shows a finished run"),
    Exclusion("ingestion.maskFolder", "the masks in use are hashed by content"),
    Exclusion("ingestion.inspection.usesMasks", "the masks in use are hashed by content"),
    Exclusion("ingestion.maximumPhotos", "the photos in use are hashed by content"),
    Exclusion("ingestion.inspection.limits", "the photos in use are hashed by content"),
    Exclusion("ingestion.memoryBudget", "the processing pixels that follow from it are hashed"),
    Exclusion("ingestion.bytesPerPixel", "the processing pixels that follow from it are hashed"),
    Exclusion("pointCloudGeneration.cacheBytes", "it bounds a cache"),
    Exclusion(
      "pointCloudGeneration.maximumPoints",
      "only a cloud that does not fit into memory depends on it"),
    Exclusion(
      "meshGeneration.poisson.maximumBytes",
      "only a surface that does not fit into memory depends on it, with a warning"),
  ]

  /// The stage that reads the options of a member. A member that is missing here counts for all
  /// stages.
  static let stages: [String: PipelineStage] = [
    // Alignment masks an object that was moved.
    "objectMasking": .imageAlignment, "movedObjects": .imageAlignment,
    "sky": .objectMasking,
    "pointCloudGeneration": .pointCloudGeneration,
    "meshGeneration": .meshGeneration, "photoRefinement": .meshGeneration,
    "simplification": .textureMapping, "tiling": .optimization, "textureMapping": .textureMapping,
    "export": .optimization, "preview": .optimization, "meshPrimitive": .optimization,
  ]

  /// Everything that the result of `stage` depends on; equal bytes for equal options.
  static func content(
    of configuration: PipelineConfiguration, through stage: PipelineStage
  ) throws -> Data {
    try content(of: try JSONValue(encoding: configuration), through: stage)
  }

  static func content(of encoded: JSONValue, through stage: PipelineStage) throws -> Data {
    var encoded = encoded
    for exclusion in exclusions { encoded.remove(exclusion.path) }
    let later = PipelineStage.allCases.drop { $0 != stage }.dropFirst()
    for (member, itsStage) in stages where later.contains(itsStage) { encoded.remove([member]) }
    return try Fingerprint.content(of: encoded)
  }
}
