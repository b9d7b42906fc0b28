import ArgumentParser
import Foundation
import Pipeline
import SharedCommands

/// Tiles of full detail besides the model.
struct TileArguments: ParsableArguments {
  @Option(
    name: .long,
    help: ArgumentHelp(
      "Also write the scene into a folder in tiles of full detail, which fit together.",
      valueName: "folder"), completion: .directory)
  var tiles: String?

  @Option(name: .long, help: "The format of tiles.")
  var tileFormat = TileFormat.glb

  enum TileFormat: String, ExpressibleByArgument, CaseIterable { case glb, usdz }

  /// What to write; nil without a folder. Throws a `CommandFailure` if the folder can't be written.
  func output() throws -> TileOutput? {
    guard let tiles else { return nil }
    let url = URL(fileURLWithPath: tiles, isDirectory: true)
    try ModelOutput.checkWritable(url)
    return TileOutput(folder: url, fileExtension: tileFormat.rawValue)
  }
}
