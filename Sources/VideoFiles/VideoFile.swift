import CKernels
import Foundation
import ImageFiles
import Kernels
import SceneModel

/// A video whose frames are decoded one after the other from its beginning.
///
/// Reads what FFmpeg's libraries decode from MP4, QuickTime, Matroska, WebM, AVI and MPEG files.
/// Frames that are damaged are passed over, and the rest is read.
package final class VideoFile {
  /// Size in pixels of upright frames.
  package let width: Int
  package let height: Int
  /// Length in seconds; nil if the file doesn't say.
  package let duration: Double?
  /// Frames per second on average; nil if the file doesn't say.
  package let frameRate: Double?
  /// The camera, as far as the file names it.
  package let camera: ExifFields

  private let raw: OpaquePointer
  private let info: ck_video_info

  /// Opens the file at `url`. Throws `VideoError`.
  package init(
    _ url: URL, threadCount: Int, limits: ImageCodec.Limits = ImageCodec.Limits()
  ) throws {
    let rawLimits = ck_decode_limits(
      maximum_side: Int32(clamping: limits.maximumSide),
      maximum_pixels: Int64(limits.maximumPixels))
    var video: OpaquePointer?
    var info = ck_video_info()
    try Self.reading {
      withUnsafePointer(to: rawLimits) {
        ck_video_open(url.path, $0, Int32(clamping: threadCount), &video, &info)
      }
    }
    guard let video else { throw VideoError.unreadable("it can't be opened") }
    raw = video
    self.info = info
    let width = max(1, Int((Double(info.width) * info.pixel_aspect).rounded()))
    let isTurned = info.rotation % 2 == 1
    self.width = isTurned ? Int(info.height) : width
    self.height = isTurned ? width : Int(info.height)
    duration = info.seconds > 0 ? info.seconds : nil
    frameRate = info.frame_rate > 0 ? info.frame_rate : nil
    camera = Self.camera(of: video)
  }

  deinit { ck_video_free(raw) }

  /// Decodes the next frame and returns its time in seconds; nil at the end.
  package func next() throws -> Double? {
    var seconds = 0.0
    var isEnd = false
    try Self.reading { ck_video_next(raw, &seconds, &isEnd) }
    return isEnd ? nil : seconds
  }

  /// The brightness of the current frame, as stored and reduced so that the longer side has at most
  /// `longerSide` pixels: neither upright nor, if its pixels aren't square, to scale.
  package func brightness(longerSide: Int) throws -> RasterImage {
    let (width, height) = (Int(info.width), Int(info.height))
    let factor = min(1, Double(longerSide) / Double(max(width, height)))
    var image = RasterImage(
      width: max(1, Int(Double(width) * factor)), height: max(1, Int(Double(height) * factor)),
      channels: 1)
    try Self.reading { image.withMutableKernelPixels { ck_video_brightness(raw, $0) } }
    return image
  }

  /// The colors of the current frame as sRGB, upright.
  package func colors() throws -> RasterImage {
    var image = RasterImage(width: Int(info.width), height: Int(info.height), channels: 3)
    try Self.reading { image.withMutableKernelPixels { ck_video_colors(raw, $0) } }
    return try image.turned(byOrientation: [1, 6, 3, 8][Int(info.rotation) % 4])
      .resized(width: width, height: height)
  }

  /// QuickTime's keys, then Android's.
  private static func camera(of video: OpaquePointer) -> ExifFields {
    func text(_ keys: String...) -> String? {
      keys.lazy.compactMap { ck_video_metadata(video, $0).map { String(cString: $0) } }.first
    }
    var fields = ExifFields()
    fields.make =
      text(
        "com.apple.quicktime.make", "com.android.manufacturer", "make") ?? "Video"
    fields.model = text("com.apple.quicktime.model", "com.android.model", "model") ?? "Video"
    fields.focalLengthIn35mmFilm = text("com.apple.quicktime.camera.focal_length.35mm_equivalent")
      .flatMap { Double($0) }.flatMap { (2...5000).contains($0) ? Int($0.rounded()) : nil }
    return fields
  }

  private static func reading(_ body: () -> ck_status) throws {
    do {
      try withKernel(KernelControl()) { _ in body() }
    } catch KernelError.outOfMemory {
      throw KernelError.outOfMemory
    } catch let error as KernelError {
      throw VideoError.unreadable(error.description)
    }
  }
}
