import ArgumentParser
import Foundation

/// Arguments of `reconstruct`; `Engine` are those of one engine.
package struct ReconstructArguments<Engine: EngineArguments>: ParsableArguments {
  @Argument(
    help: ArgumentHelp("The folder with the photos: JPEG, HEIC or PNG.", valueName: "input-folder"),
    completion: .directory)
  package var inputFolder: String

  @Argument(
    help: ArgumentHelp(
      "The file or folder of the model; its extension selects the format, see above.",
      valueName: "output"), completion: .file())
  package var output: String

  @OptionGroup package var detail: DetailArguments

  @OptionGroup package var alignment: AlignmentArguments

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Keep intermediate results in this folder and resume from them.", valueName: "folder"),
    completion: .directory)
  package var checkpointDirectory: String?

  @Option(
    name: .long,
    help: ArgumentHelp("Write the camera poses as JSON.", valueName: "file.json"),
    completion: .file(extensions: ["json"]))
  package var poses: String?

  @Option(
    name: .long, help: ArgumentHelp("Write the colored points as PLY.", valueName: "file.ply"),
    completion: .file(extensions: ["ply"]))
  package var pointCloud: String?

  @Flag(name: .long, help: "Keep the surroundings instead of isolating the object; ignore masks.")
  package var noObjectMasking = false

  @OptionGroup package var shape: ShapeArguments

  @OptionGroup package var engine: Engine

  @Flag(name: .long, help: "Report progress and results as JSON Lines on stdout.")
  package var json = false

  @Flag(
    name: .long,
    help: ArgumentHelp("Stop when standard input ends.", visibility: .hidden))
  package var untilInputEnds = false

  @OptionGroup package var logging: LoggingOptions

  package init() {}
}

extension ReconstructArguments {
  /// The configuration of the session.
  package var sessionConfiguration: PhotogrammetrySession.Configuration {
    var configuration = PhotogrammetrySession.Configuration()
    configuration.isObjectMaskingEnabled = !noObjectMasking
    alignment.configure(&configuration)
    configuration.checkpointDirectory = checkpointDirectory.map {
      URL(fileURLWithPath: $0, isDirectory: true)
    }
    configuration.customDetailSpecification = detail.specification
    configuration.meshPrimitive = shape.primitive
    return configuration
  }
}
