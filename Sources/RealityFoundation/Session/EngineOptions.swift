import Formats
import Pipeline

/// Options of this engine beyond Apple's configuration.
package struct EngineOptions: Equatable, Sendable {
  /// Threads of all stages. Results do not depend on it.
  package var threadCount = ProcessInfo.processInfo.activeProcessorCount
  /// Closes what no photo shows of an isolated object.
  package var closesObject = true
  /// Fits the finished surface to the photos at a finer resolution.
  package var refinesSurface = false
  /// Measured distances in the scene, which give the scale. Photos are named by their files.
  package var knownDistances: [KnownDistance] = []
  /// A PNG file that shows the model from several sides; nil draws none.
  package var previewFile: URL?
  /// Formats of model files that are accepted in addition to USDZ. None by default: a program
  /// written for Apple's engine gets `Error.invalidOutput` where it would there.
  package var additionalFileFormats: Set<ModelFormat> = []
  /// A folder with the photos' masks; nil searches the folder of photos.
  package var maskFolder: URL?

  package init() {}
}
