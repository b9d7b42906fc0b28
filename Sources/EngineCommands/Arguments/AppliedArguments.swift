import Foundation
import Pipeline
import SharedCommands

// How options of the command line become the configuration of a run. Each command starts from the
// defaults, which are within the limits of the machine, and applies its groups of options.

extension ThreadArguments {
  func apply(to configuration: inout PipelineConfiguration) {
    configuration.threadCount = threadCount
  }
}

extension MaskArguments {
  /// With `areIgnored` photos are used entirely; otherwise throws a `CommandFailure` if the folder
  /// of the masks can't be read.
  func apply(to configuration: inout PipelineConfiguration, areIgnored: Bool = false) throws {
    configuration.isObjectMaskingEnabled = !areIgnored
    configuration.ingestion.maskFolder = try folder
  }
}

extension AlignmentArguments {
  func apply(to configuration: inout PipelineConfiguration) {
    configuration.alignment.ordering = sampleOrdering
    configuration.alignment.features.sensitivity = featureSensitivity
  }
}

extension ScaleArguments {
  /// Throws a `CommandFailure` if a distance can't be used with the folder `photos`.
  func apply(to configuration: inout PipelineConfiguration, photos: URL) throws {
    configuration.alignment.worldAlignment.knownDistances = try knownDistances(photos: photos)
  }
}

extension UpArguments {
  func apply(to configuration: inout PipelineConfiguration) {
    configuration.alignment.worldAlignment.chosenUp = up?.direction
  }
}

extension PreviewArguments {
  /// Throws a `CommandFailure` if the file can't be written.
  func apply(to configuration: inout PipelineConfiguration) throws {
    configuration.previewFile = try file()
  }
}

extension ShapeArguments {
  func apply(to configuration: inout PipelineConfiguration) {
    configuration.meshPrimitive = quads ? .quad : .triangle
  }
}
