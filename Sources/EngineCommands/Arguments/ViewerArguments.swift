import ArgumentParser
import SharedCommands

/// A page that shows the model.
struct ViewerArguments: ParsableArguments {
  @Flag(
    name: .long,
    help: "Also write a page beside the model that shows it in a browser: model.html.")
  var viewer = false

  /// The file to write; throws a `CommandFailure` if it can't be written.
  func file(of model: ModelOutput, besides report: ReportFile?) throws -> ViewerFile? {
    guard viewer else { return nil }
    let file = try ViewerFile(of: model)
    guard file.url.standardizedFileURL != report?.url.standardizedFileURL else {
      throw CommandFailure.usage(
        "--report and --viewer would both write \(file.url.relativePath). Give the report another "
          + "name.")
    }
    return file
  }
}
