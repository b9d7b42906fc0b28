import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Turns a video into photos: sharp frames at even distances along the camera's path.
package struct VideoFrames: Sendable {
  package struct Options: Hashable, Sendable {
    /// Number of photos; nil chooses it by the length of the path.
    package var count: Int?
    /// JPEG quality of the photos, 0…1. Chosen: finer than the compression of videos.
    package var quality: Float = 0.95
    package var selection = FrameSelection.Options()

    package init() {}
  }

  /// A photo made of a frame.
  package struct Photo: Sendable {
    /// `clip_0012.345.jpg` for the frame of `clip.mov` at 12.345 s.
    package var name: String
    /// The content of the file.
    package var jpeg: [UInt8]
  }

  /// What was selected.
  package struct Summary: Hashable, Sendable {
    /// Number of photos.
    package var photos: Int
    /// Number of frames of the video that were examined.
    package var examined: Int
    /// Length of the video in seconds, up to its last frame.
    package var seconds: Double
  }

  /// Fewer photos can't be reconstructed. Limit: as `PipelineError.minimumPhotos`.
  private static let minimumPhotos = 3
  /// The share of the time that reading the video for the first time takes: both decode it, and the
  /// first also measures. Chosen: for progress only.
  private static let analysisShare = 0.75

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Passes the photos to `write`, in order. Throws `VideoError`, and what `write` throws.
  ///
  /// Depends on the file only, not on the number of threads.
  package func run(
    _ url: URL, _ control: KernelControl, write: (Photo) throws -> Void
  ) throws -> Summary {
    let threads = control.threadCount
    let readings = try VideoAnalysis().run(
      VideoFile(url, threadCount: threads), control.part(from: 0, to: Self.analysisShare))
    let selected = FrameSelection(options.selection).run(readings, count: options.count)
    guard selected.count >= Self.minimumPhotos else {
      throw VideoError.tooFewFrames(selected.count)
    }
    try extract(
      selected, from: url, control.part(from: Self.analysisShare, to: 1), write: write)
    return Summary(
      photos: selected.count, examined: readings.count, seconds: readings.last?.seconds ?? 0)
  }

  /// Decodes the video again, up to the last selected frame.
  private func extract(
    _ selected: [FrameReading], from url: URL, _ control: KernelControl,
    write: (Photo) throws -> Void
  ) throws {
    let video = try VideoFile(url, threadCount: control.threadCount)
    let stem = url.deletingPathExtension().lastPathComponent
    var index = 0
    for (number, frame) in selected.enumerated() {
      try control.step(Double(number) / Double(selected.count))
      while index <= frame.index {
        try control.checkCancellation()
        guard try video.next() != nil else { return }
        index += 1
      }
      let jpeg = try ImageCodec.encodeJPEG(video.colors(), quality: options.quality)
      try write(
        Photo(
          name: "\(stem)_\(Self.time(frame.seconds)).jpg",
          jpeg: ExifWriter.jpeg(jpeg, with: video.camera)))
    }
  }

  /// Seconds with four digits before the point and three behind it, so that names sort by time.
  private static func time(_ seconds: Double) -> String {
    let milliseconds = Int((max(0, seconds) * 1000).rounded())
    func padded(_ value: Int, _ digits: Int) -> String {
      let text = String(value)
      return String(repeating: "0", count: max(0, digits - text.count)) + text
    }
    return "\(padded(milliseconds / 1000, 4)).\(padded(milliseconds % 1000, 3))"
  }
}
