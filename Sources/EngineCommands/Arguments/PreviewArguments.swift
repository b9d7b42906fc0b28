import ArgumentParser
import Foundation
import SharedCommands

/// A picture of the model.
struct PreviewArguments: ParsableArguments {
  @Option(
    name: .long,
    help: ArgumentHelp(
      "Render the model from eight sides into one picture.", valueName: "file.png"),
    completion: .file(extensions: ["png"]))
  var preview: String?

  /// The file to write; throws a `CommandFailure` if it can't be written.
  func file() throws -> URL? {
    guard let preview else { return nil }
    guard (preview as NSString).pathExtension.lowercased() == "png" else {
      throw CommandFailure.usage(
        "The preview \(preview) is not named like a PNG file. Name a .png file.")
    }
    let url = URL(fileURLWithPath: preview, isDirectory: false)
    try ModelOutput.checkWritable(url)
    return url
  }
}
