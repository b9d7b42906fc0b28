import ArgumentParser
import Foundation
import RealityKit

/// Makes a model from a folder of photos.
struct Reconstruct: AsyncParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "reconstruct",
    abstract: "Reconstruct an object from photos.",
    usage: """
      photogrammetry-cli <input-folder> <output> [options]
      """,
    discussion: """
      Take 20 to 200 sharp photos all around the object, each overlapping its neighbors by 70 % or \
      more, with the object still and the light even.

      EXAMPLES
        photogrammetry-cli photos/ model.usdz
            One file for AR Quick Look, at the 'reduced' level.
        photogrammetry-cli photos/ model.usdz -d medium --checkpoint-directory work/
            More detail; sparse/, dense/, mesh/ and report.json stay in work/.
        photogrammetry-cli photos/ model.usdz --preview model.png
            A picture of the model from eight sides besides.
        photogrammetry-cli photos/ model/ --poses poses.json --point-cloud points.ply
            A folder with OBJ, MTL, USDA and textures, and what else is known.
        photogrammetry-cli photos/ shop.glb -d custom --max-polygons 20000 \\
            --texture-side 1024 --maps color --texture-format jpeg:0.7
            Bounds of your own, for a web shop.
        photogrammetry-cli facade/ facade.usdz --no-object-masking -o sequential
            A scene instead of an object, photographed from left to right.

      \(DetailArguments.help)
      \(EngineArguments.outputHelp)
      \(EngineArguments.maskHelp)
      \(EngineArguments.scaleHelp)
      \(RunEvent.help)
      Paths of what was written go to stdout, everything else to stderr.
      """)

  @Argument(
    help: ArgumentHelp("The folder with the photos: JPEG, HEIC or PNG.", valueName: "input-folder"),
    completion: .directory)
  var inputFolder: String

  @Argument(
    help: ArgumentHelp(
      "A file or folder for the model; its name decides about the format, see above.",
      valueName: "output"), completion: .file())
  var output: String

  @OptionGroup var detail: DetailArguments

  @OptionGroup var alignment: AlignmentArguments

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Leave sparse/, dense/, mesh/ and report.json there, for other tools.", valueName: "folder"),
    completion: .directory)
  var checkpointDirectory: String?

  @Option(
    name: .long,
    help: ArgumentHelp("Write the cameras' poses as JSON.", valueName: "file.json"),
    completion: .file(extensions: ["json"]))
  var poses: String?

  @Option(
    name: .long, help: ArgumentHelp("Write the coloured points as PLY.", valueName: "file.ply"),
    completion: .file(extensions: ["ply"]))
  var pointCloud: String?

  @OptionGroup var preview: PreviewArguments

  @Flag(name: .long, help: "Keep the surroundings instead of isolating the object; ignore masks.")
  var noObjectMasking = false

  @OptionGroup var surface: SurfaceArguments

  @OptionGroup var shape: ShapeArguments

  @OptionGroup var engine: EngineArguments

  @Flag(name: .long, help: "Tell progress and results as JSON, an object a line, on stdout.")
  var json = false

  @OptionGroup var dryRun: DryRunArguments

  @Flag(
    name: .long,
    help: ArgumentHelp("Stop when standard input ends.", visibility: .hidden))
  var untilInputEnds = false

  @OptionGroup var logging: LoggingOptions

  mutating func run() async throws {
    logging.bootstrap()
    let reporter = RunReporter(logging.style(json: json))
    do {
      try await ReconstructionJob(self).run(reporter)
    } catch {
      reporter.failed(error)
      throw error
    }
  }
}
