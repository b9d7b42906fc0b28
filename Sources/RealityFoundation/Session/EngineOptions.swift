import Formats
import Pipeline

/// Options of this engine beyond Apple's configuration.
package struct EngineOptions: Equatable, Sendable {
  /// The number of threads of all stages; does not affect the results.
  package var threadCount = ProcessorShare.current.threads
  /// Whether to close the surface of an isolated object where no photo shows it.
  package var closesObject = true
  /// Whether to fit the finished surface to the photos at a higher resolution.
  package var refinesSurface = false
  /// Measured distances in the scene, which give the scale. Photos are named by their files.
  package var knownDistances: [KnownDistance] = []
  /// What is up in the model; nil leaves it to the engine.
  package var up: ChosenUp?
  /// The PNG file of a preview that shows the model from several sides, the finest one of several;
  /// nil renders none.
  package var previewFile: URL?
  /// Whether pictures, the model and points are kept for the page of a report.
  package var keepsReportMaterial = false
  /// Whether GLB files are compressed, by extensions of glTF that readers must support.
  package var compressesGLB = false
  /// Formats of model files that are accepted in addition to USDZ. None by default: a program
  /// written for Apple's engine gets `Error.invalidOutput` in the same cases.
  package var additionalFileFormats: Set<ModelFormat> = []
  /// A folder with the photos' masks; nil searches the folder of photos.
  package var maskFolder: URL?
  /// Folder that receives the masks in use as PNG files; nil writes none.
  package var maskOutput: URL?
  /// Where the scene is written in tiles of full detail, too; nil makes none.
  package var tiles: TileOutput?
  /// Whether other processes use the checkpoint directory at the same time.
  package var sharesCheckpoint = false
  /// Options of the configuration with another value, for measurements.
  package var overrides: [OptionOverride] = []

  package init() {}
}
