import ArgumentParser
import Formats
import Foundation
import Pipeline
import RealityFoundation
import SharedCommands

/// Options of `reconstruct` that only this project's engine has.
package struct PipelineArguments: EngineArguments {
  @OptionGroup var video: VideoArguments

  @OptionGroup var preview: PreviewArguments

  @OptionGroup var viewer: ViewerArguments

  @OptionGroup var compression: CompressionArguments

  @OptionGroup var tiles: TileArguments

  @OptionGroup var surface: SurfaceArguments

  @OptionGroup var masking: MaskArguments

  @OptionGroup var maskOutput: MaskOutputArguments

  @OptionGroup var runArguments: RunArguments

  @OptionGroup var scale: ScaleArguments

  @OptionGroup var frame: UpArguments

  @Flag(
    name: .customLong("dry-run"),
    help: "Check photos, masks, output and machine, print what a run would do, and exit.")
  var isDryRun = false

  @OptionGroup var slurm: SlurmArguments

  @Option(
    name: .long,
    help: ArgumentHelp(
      "With --slurm or --plan: the photos, or views, of a chunk (default: 32; work of a few "
        + "seconds is not divided).", valueName: "count"))
  var photosPerChunk: Int?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Make only a part of the run, for other processes.", valueName: "part",
      visibility: .hidden))
  var part: PartArgument?

  package init() {}

  package func validate() throws {
    if let photosPerChunk, photosPerChunk < 1 {
      throw ValidationError("--photos-per-chunk must be 1 or more.")
    }
  }

  package func check(_ output: ModelOutput, _ detail: DetailArguments) throws {
    try compression.check(output.format, detail)
    try runArguments.checkOverrides()
  }

  package func outputs(with model: ModelOutput) throws -> EngineOutputs {
    _ = try viewerFile(of: model)
    return EngineOutputs(preview: try preview.file())
  }

  package func configure(_ session: PhotogrammetrySession, photos folder: URL) throws {
    session.engineOptions.threadCount = runArguments.threading.threadCount
    session.engineOptions.knownDistances = try scale.knownDistances(photos: folder)
    session.engineOptions.up = frame.up?.direction
    session.engineOptions.additionalFileFormats = Set(ModelFormat.files)
    session.engineOptions.maskFolder = try masking.folder
    session.engineOptions.maskOutput = try maskOutput.folder(photos: folder)
    session.engineOptions.previewFile = try preview.file()
    let isBesideTiles = part == .model
    session.engineOptions.tiles = try isBesideTiles ? nil : tiles.output()
    session.engineOptions.sharesCheckpoint = isBesideTiles
    session.engineOptions.keepsReportMaterial =
      try viewer.viewer || runArguments.reportFile()?.isPage == true
    session.engineOptions.compressesGLB = compression.compress
    session.engineOptions.closesObject = !surface.keepGaps
    session.engineOptions.refinesSurface = surface.refine
    session.engineOptions.overrides = runArguments.set
  }

  private func viewerFile(of model: ModelOutput) throws -> ViewerFile? {
    try viewer.file(of: model, besides: try runArguments.reportFile())
  }

  package func files(
    of session: PhotogrammetrySession, photos: URL, model: ModelOutput
  ) throws -> [EngineFile] {
    let (report, material) = (session.report, session.reportMaterial)
    var files: [EngineFile] = []
    if let file = try runArguments.reportFile(), let report {
      let content = try file.content(report, material, photos: photos, output: model.url)
      files.append(EngineFile(kind: "report", url: file.url, content: content))
    }
    if let file = try viewerFile(of: model),
      let content = try file.content(material, name: model.url.lastPathComponent)
    {
      files.append(EngineFile(kind: "viewer", url: file.url, content: content))
    }
    return files
  }
}
