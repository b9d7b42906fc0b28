import ArgumentParser
import Foundation
import SharedCommands

/// The folder that receives the masks of the object.
struct MaskOutputArguments: ParsableArguments {
  /// How masks are estimated, as a section of help.
  static let help = """
    OBJECT
      Without masks the object is what the photos are aimed at, above its support
      and without backdrop. Its masks are estimated; --write-masks writes them, to
      be corrected in an image editor and used with --masks. Surroundings that are
      kept with --no-object-masking have no sky.

    """

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Write the object's masks, given or estimated, into a folder as PNG.",
      valueName: "folder"), completion: .directory)
  var writeMasks: String?

  /// The folder; nil if none is named. Throws a `CommandFailure` if it can't be written, or if it
  /// is the folder of the photos, which masks of the same name would replace.
  func folder(photos: URL) throws -> URL? {
    guard let writeMasks else { return nil }
    let url = URL(fileURLWithPath: writeMasks, isDirectory: true)
    guard url.resolvingSymlinksInPath().path != photos.resolvingSymlinksInPath().path else {
      throw CommandFailure.usage(
        "\(writeMasks) is the folder of the photos. Name another folder for the masks.")
    }
    try ModelOutput.checkWritable(url)
    return url
  }
}
