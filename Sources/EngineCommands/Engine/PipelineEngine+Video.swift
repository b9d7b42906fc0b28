import Foundation
import SharedCommands

extension PipelineEngine {
  package static func input(_ path: String) throws -> PhotoInput { try VideoInput.input(path) }

  package static func photos(
    of video: URL, _ arguments: ReconstructArguments<PipelineArguments>, _ reporter: RunReporter
  ) throws -> InputPhotos {
    let extraction = FrameExtraction(
      video: video, options: arguments.engine.video.options,
      threadCount: arguments.engine.runArguments.threading.threadCount)
    let checkpoint = arguments.checkpointDirectory.map {
      URL(fileURLWithPath: $0, isDirectory: true)
    }
    return try FrameFolder(extraction: extraction, checkpoint: checkpoint).photos(reporter)
  }
}
