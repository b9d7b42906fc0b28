import ArgumentParser

@main
struct PhotogrammetryCLI: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "photogrammetry-cli", abstract: "Photos in, a textured 3-D model out.")
}
