import Formats
import Foundation
import Logging
import Pipeline
import SharedCommands

/// The folder in which a run finds the frames of a video.
struct FrameFolder {
  let extraction: FrameExtraction
  /// The folder of the run's intermediate results, in which frames are kept.
  let checkpoint: URL?

  /// Extracts the frames unless the checkpoint has them. Throws a `CommandFailure`.
  func photos(_ reporter: RunReporter) throws -> InputPhotos {
    guard let checkpoint else {
      let scratch = try ScratchFolder()
      try extract(into: scratch.url, reporter)
      return InputPhotos(scratch.url, owner: scratch)
    }
    let folder = checkpoint.appendingPathComponent("frames", isDirectory: true)
    let recordFile = checkpoint.appendingPathComponent("frames.json")
    let record = try FrameRecord(
      extraction.video, extraction.options, program: String(ProgramIdentity.fingerprint))
    let exists = FileManager.default.fileExists(atPath: folder.path)
    if !exists || FrameRecord(file: recordFile) != record {
      try FileManager.default.createDirectory(at: checkpoint, withIntermediateDirectories: true)
      try? FileManager.default.removeItem(at: folder)
      try AtomicDirectory.write(to: folder) { try extract(into: $0, reporter) }
      try AtomicFile.write(JSONEncoder.readable.encode(record), to: recordFile)
    }
    return InputPhotos(folder)
  }

  private func extract(into folder: URL, _ reporter: RunReporter) throws {
    let summary = try extraction.run(into: folder, reporter)
    Logger(label: "photogrammetry-cli").info(
      "\(extraction.video.lastPathComponent): \(summary.sentence)")
  }
}
