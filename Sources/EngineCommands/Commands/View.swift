import ArgumentParser
import Formats
import Foundation
import Kernels
import Logging
import Pipeline
import SceneModel
import SharedCommands

/// Makes a page that shows a model in a browser.
struct View: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "view",
    abstract: "Show a model in a browser.",
    discussion: """
      Writes a page beside the model, and opens it if there is a browser. The page is one file \
      without links: it can be sent by mail or put on a web server. Turn the model with the mouse, \
      with a finger or with the arrow keys.

      Models of this and of other programs can be viewed: \(ModelFile.formats). Of the checkpoint \
      directory of a run, the page is its report, with the surface before simplification, the \
      cameras and the points.

      EXAMPLES
        photogrammetry-cli view model.usdz
            Writes model.html and opens it.
        photogrammetry-cli view model.glb page.html --no-open
            Another name; prints it without opening it.
        photogrammetry-cli view work/
            A finished run with --checkpoint-directory work/.

      Exit codes: 0 the page was written, 1 it could not be written, 2 there is no model that can \
      be read.
      """)

  @Argument(
    help: ArgumentHelp(
      "A file or folder with a model, or the checkpoint directory of a run.", valueName: "model"),
    completion: .file())
  var model: String

  @Argument(
    help: ArgumentHelp("The page. (default: beside the model)", valueName: "page.html"),
    completion: .file(extensions: ["html"]))
  var page: String?

  @Flag(name: .long, help: "Don't open the page.")
  var noOpen = false

  @Option(
    name: .long,
    help: ArgumentHelp(
      "The folder with the photos of a checkpoint, if they were moved since the run.",
      valueName: "folder"),
    completion: .directory)
  var photos: String?

  @OptionGroup var threading: ThreadArguments

  @OptionGroup var logging: LoggingOptions

  mutating func run() throws {
    logging.bootstrap()
    let source = URL(fileURLWithPath: model)
    let target = try target(for: source)
    let control = KernelControl(threadCount: threading.threadCount)
    let content =
      Checkpoint.isOne(source)
      ? try reportPage(of: source, control) : try modelPage(of: source, control)
    try AtomicFile.write(content, to: target)
    Terminal.shared.result(target.relativePath)
    if !noOpen { Browser.open(target) }
  }
}

extension View {
  /// The file to write; throws a `CommandFailure` if it can't be written.
  private func target(for source: URL) throws -> URL {
    let path = source.relativePath as NSString
    let url = URL(
      fileURLWithPath: page ?? "\(path.deletingPathExtension).html", isDirectory: false)
    try ModelOutput.checkWritable(url)
    guard url.standardizedFileURL.path != source.standardizedFileURL.path else {
      throw CommandFailure.usage("\(model) is a page already. Name the model.")
    }
    return url
  }

  private func modelPage(of source: URL, _ control: KernelControl) throws -> Data {
    let loaded: LoadedModel
    do {
      loaded = try ModelFile.read(source, decompressedBy: MeshoptDecoder())
    } catch let error as FormatError {
      throw CommandFailure.usage(CommandFailure(error).sentence)
    }
    if !loaded.missingFiles.isEmpty {
      let names = loaded.missingFiles.joined(separator: ", ")
      Logger(label: "photogrammetry-cli").warning(
        "\(model) refers to files that can't be shown: \(names).")
    }
    var material = ReportMaterial()
    material.isViewer = true
    material.model = try PageModel(loaded, control)
    material.facts = ModelFacts(loaded, file: source).rows
    let name = source.lastPathComponent
    return try ReportFile.page(title: name, report: ViewerFile.titleOnly(name), material)
  }

  private func reportPage(of checkpoint: URL, _ control: KernelControl) throws -> Data {
    do {
      let folder = try photos.map { try PhotoFolderArgument($0).url }
      let saved = try SavedRun(checkpoint: checkpoint, photos: folder)
      let report = try saved.reportData()
      return try ReportFile.page(
        title: "\(checkpoint.lastPathComponent) – report", report: report.json,
        try ReportMaterial(saved, names: report.names, StageContext(control: control)))
    } catch let error as SavedRunError {
      throw CommandFailure.usage(CommandFailure(error).sentence)
    }
  }
}
