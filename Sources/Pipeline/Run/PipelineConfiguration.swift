import Foundation

/// What a whole run is told.
package struct PipelineConfiguration: Hashable, Codable, Sendable {
  /// Separate the object from its support and background; where photos have masks, by these.
  package var isObjectMaskingEnabled: Bool = true
  /// A folder with the photos' masks; nil looks inside the folder of photos.
  package var maskFolder: URL?
  /// Close what no photo shows of the object, its underside for instance.
  package var closesObject: Bool = true
  /// Fit the surface to the photos at up to four times the pixels of the dense stage.
  package var refinesSurface: Bool = false
  /// The faces of model files, where the format has a choice.
  package var meshPrimitive = MeshPrimitive.triangle
  /// The photos are in the order of capture, and neighbors overlap.
  package var isSequential: Bool = false
  /// Look harder for features on objects of low texture.
  package var isHighSensitivity: Bool = false
  /// Distances in the scene that were measured; they give the scale.
  package var knownDistances: [KnownDistance] = []
  /// How poses are found.
  package var mappingMethod = MappingMethod.automatic
  /// The dense stage; its resolution follows the detail level.
  package var pointCloudGeneration = PointCloudGeneration.Options()
  /// Where intermediate results are left; nil leaves none.
  package var checkpointDirectory: URL?
  /// A PNG file that shows each model from several sides; nil draws none.
  package var previewFile: URL?
  /// Threads of all stages. Results do not depend on it.
  package var threadCount: Int = ProcessInfo.processInfo.activeProcessorCount
  /// Bytes that decoded photos may take.
  package var imageMemory: Int = 1 << 30

  /// Photos beyond this number are refused.
  package var maximumPhotos: Int = 1000
  /// Photos with a longer side, in pixels, are refused.
  package var maximumPhotoSide: Int = 16384

  package init() {}
}

/// The faces of a mesh.
package enum MeshPrimitive: String, CaseIterable, Codable, Sendable {
  case triangle
  /// Two triangles where they fit together, and triangles where they don't.
  case quad
}

/// The stages of a run in their order; the cases of `Output.ProcessingStage`.
package enum PipelineStage: String, CaseIterable, Codable, Sendable {
  case preProcessing, imageAlignment, pointCloudGeneration, meshGeneration, textureMapping
  case optimization
}
