import Formats
import Pipeline

/// What our engine can be told beyond Apple's configuration.
package struct EngineOptions: Equatable, Sendable {
  /// Threads of all stages. Results do not depend on it.
  package var threadCount = ProcessInfo.processInfo.activeProcessorCount
  /// Close what no photo shows of an isolated object.
  package var closesObject = true
  /// Fit the surface to the photos at a finer resolution once it is made.
  package var refinesSurface = false
  /// Distances in the scene that were measured; they give the scale. Photos are named by their files.
  package var knownDistances: [KnownDistance] = []
  /// A PNG file that shows the model from several sides; nil draws none.
  package var previewFile: URL?
  /// Formats of model files that are accepted besides USDZ. None: a program written for Apple's engine
  /// meets `Error.invalidOutput` where it would there.
  package var additionalFileFormats: Set<ModelFormat> = []
  /// A folder with the photos' masks; nil looks inside the folder of photos.
  package var maskFolder: URL?

  package init() {}
}
