import Foundation
import Kernels
import VideoFiles

/// From what the frames in a checkpoint were made: they are made again if anything differs.
struct FrameRecord: Codable, Equatable {
  /// The name of the video.
  let video: String
  /// The hash of its content.
  let content: UInt64
  /// The requested number of photos.
  let frames: Int?
  /// The program that chose the frames.
  let program: String

  /// Reads the video.
  init(_ video: URL, _ options: VideoFrames.Options, program: String) throws {
    self.video = video.lastPathComponent
    let data = try Data(contentsOf: video, options: .mappedIfSafe)
    content = data.withUnsafeBytes { XXHash64.hash($0) }
    frames = options.count
    self.program = program
  }

  /// The record in the file; nil if there is none or it is damaged.
  init?(file: URL) {
    guard let data = try? Data(contentsOf: file),
      let record = try? JSONDecoder().decode(Self.self, from: data)
    else { return nil }
    self = record
  }
}
