import Formats
import Foundation
import Kernels
import SharedCommands
import VideoFiles

/// Saves frames of a video as photos in a folder, with progress, until an interrupt.
struct FrameExtraction {
  let video: URL
  let options: VideoFrames.Options
  let threadCount: Int

  /// Writes the photos into `folder`, which exists. Throws a `CommandFailure`.
  func run(into folder: URL, _ reporter: RunReporter) throws -> VideoFrames.Summary {
    if let remedy = VideoSupport.current.remedy {
      throw CommandFailure.run(
        "\(video.lastPathComponent) is not a folder of photos, and this program can't read videos. "
          + remedy)
    }
    let flag = CancellationFlag()
    let interrupts = InterruptHandler { flag.cancel() }
    let progress = ProgressBox(reporter, stage: .frameSelection)
    defer { progress.finish() }
    let control = KernelControl(threadCount: threadCount, flag: flag) { progress.update($0) }
    do {
      return try VideoFrames(options).run(video, control) { photo in
        try AtomicFile.write(photo.jpeg, to: folder.appendingPathComponent(photo.name))
      }
    } catch let error as VideoError {
      throw CommandFailure.run("\(video.lastPathComponent): \(error.localizedDescription).")
    } catch is CancellationError where interrupts.wasInterrupted {
      throw CommandFailure.interrupted("Interrupted; no frames were saved.")
    }
  }
}

extension VideoFrames.Summary {
  /// `93 of 450 frames became photos (30.0 s of video).`
  var sentence: String {
    let tenths = (seconds * 10).rounded() / 10
    return "\(photos) of \(examined) frames became photos (\(tenths) s of video)."
  }
}
