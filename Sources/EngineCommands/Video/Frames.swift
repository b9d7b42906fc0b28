import ArgumentParser
import Formats
import Foundation
import SharedCommands

/// Saves the frames of a video that a run would use.
struct Frames: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "frames",
    abstract: "Save frames of a video as photos: sharp ones at even distances.",
    discussion: """
      'reconstruct' does the same when it is given a video. Use this command to look at the \
      frames, to take out those that show someone in front of the object, to add photos, or for \
      the commands that take a folder.

      The camera's path is measured by the features that frames share. Along it, the sharpest \
      frame near each place is taken; where the camera stands still, none. HDR (HLG and PQ) \
      becomes sRGB. The same video gives the same photos.

      EXAMPLES
        photogrammetry-cli frames clip.mov photos/
        photogrammetry-cli frames clip.mov photos/ --frames 120

      Exit codes: 0 the photos were written, 1 the video can't be read or is too short, 2 invalid \
      arguments or paths, 130 interrupted.
      """)

  @Argument(help: ArgumentHelp("The video.", valueName: "video"), completion: .file())
  var video: String

  @Argument(
    help: ArgumentHelp("The folder for the photos; must not exist yet.", valueName: "output"),
    completion: .directory)
  var output: String

  @OptionGroup var arguments: VideoArguments

  @OptionGroup var threading: ThreadArguments

  @OptionGroup var logging: LoggingOptions

  mutating func run() throws {
    logging.bootstrap()
    guard case .video(let file) = try VideoInput.input(video) else {
      throw CommandFailure.usage("\(video) is a folder. Name a video.")
    }
    let folder = URL(fileURLWithPath: output, isDirectory: true)
    guard !FileManager.default.fileExists(atPath: folder.path) else {
      throw CommandFailure.usage("\(output) exists already. Name a new folder.")
    }
    try ModelOutput.checkWritable(folder)
    let extraction = FrameExtraction(
      video: file, options: arguments.options, threadCount: threading.threadCount)
    let reporter = RunReporter(logging.style())
    try AtomicDirectory.write(to: folder) { folder in
      let summary = try extraction.run(into: folder, reporter)
      if !logging.quiet { Terminal.shared.message(summary.sentence) }
    }
    Terminal.shared.result(output)
  }
}
