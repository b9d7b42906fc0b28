import ArgumentParser
import Formats
import Foundation
import Kernels
import Pipeline
import SceneModel
import SharedCommands

/// Lists the photos that a run would use.
struct Inspect: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "inspect",
    abstract: "List the photos of a folder that a run would use, and why others are rejected.",
    discussion: """
      Reads and checks all photos and masks as 'reconstruct' does, without reconstructing. With \
      --overlap it also lists which photos show the same parts and which overlap with none, so \
      that you know where to take more photos; this takes as long as the first half of alignment. \
      Masks, -o and -f affect the overlap as they affect a run.

      EXAMPLES
        photogrammetry-cli inspect photos/
        photogrammetry-cli inspect photos/ --overlap
        photogrammetry-cli inspect photos/ --overlap --report photos.html
            A page with the photos, the reasons and the gaps between them.

      Exit codes: 0 there are enough photos, 1 there are too few, 2 the folder can't be read.
      """)

  @Argument(
    help: ArgumentHelp("The folder with the photos.", valueName: "input-folder"),
    completion: .directory)
  var inputFolder: String

  @Flag(name: .long, help: "List which photos overlap.")
  var overlap = false

  @Flag(name: .long, help: "Print one JSON object instead of a table.")
  var json = false

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Write a report: a page for a browser (.html), or all figures as JSON (.json).",
      valueName: "file"),
    completion: .file(extensions: ["html", "json"]))
  var report: String?

  @OptionGroup var alignment: AlignmentArguments

  @OptionGroup var threading: ThreadArguments

  @OptionGroup var masking: MaskArguments

  @OptionGroup var logging: LoggingOptions

  mutating func run() throws {
    logging.bootstrap()
    let folder = try PhotoFolderArgument(inputFolder).url
    let file = try self.report.map(ReportFile.init)
    var configuration = PipelineConfiguration()
    threading.apply(to: &configuration)
    try masking.apply(to: &configuration)
    alignment.apply(to: &configuration)
    let reporter = ProgressBox(RunReporter(logging.style()), stage: .preProcessing)
    let control = KernelControl(threadCount: configuration.threadCount) { reporter.update($0) }
    let ingested = try PhotoIngestion(configuration.ingestion).run(
      folder: folder, StageContext(control: control))
    var report = InspectionReport(ingested)
    let images = ImageStore(
      photos: ingested.photos, byteBudget: configuration.imageMemory,
      processingPixels: ingested.processingPixels)
    let notes = StageNotes()
    if overlap, ingested.photos.count >= 2 {
      let survey = try OverlapSurvey(configuration.alignmentOptions(for: images)).run(
        photos: ingested.photos, cameras: ingested.cameras, images: images,
        StageContext(control: control, notes: notes))
      report.overlap = OverlapReport(survey, ingested.photos)
    }
    reporter.finish()
    try file?.write(ingested, notes.matches, images, configuration, folder)
    if json {
      Terminal.shared.result(try report.encoded())
    } else {
      report.lines.forEach(Terminal.shared.result)
    }
    try report.checkCount()
  }
}

extension ReportFile {
  /// Writes what is known about the photos in `folder` before a run.
  fileprivate func write(
    _ ingested: IngestedPhotos, _ matches: MatchRecord?, _ images: ImageStore,
    _ configuration: PipelineConfiguration, _ folder: URL
  ) throws {
    let report = RunReport(ingested, matches, configuration: configuration)
    let control = KernelControl(threadCount: configuration.threadCount)
    let material =
      isPage
      ? try ReportMaterial(
        ingested, images: images, names: report.photos.map(\.name), control) : nil
    let content = try content(report, material, photos: folder, output: nil)
    try AtomicFile.write(content, to: url)
  }
}
