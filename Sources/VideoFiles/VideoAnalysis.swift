import Foundation
import Kernels
import SceneModel

/// Measures the sharpness of a video's frames and the motion between them.
struct VideoAnalysis {
  struct Options: Hashable, Sendable {
    /// Frames measured per second at most: a trembling hand rests for a frame or two at a time.
    /// Measured: on a rendered walk (`render-fixtures video 5`), 15 and a tolerance of 0.25 gave an
    /// F-score of 0.959 at 1 mm, 30 and 0.4 one of 0.972.
    var framesPerSecond = 30.0
    /// Longer side in pixels at which sharpness is measured: a blur of three pixels of a 4K frame
    /// is one pixel here. Chosen.
    var sharpnessSide = 1280
    /// Longer side in pixels at which features are detected. Chosen.
    var featureSide = 640
    /// Features per frame at most. Chosen: the mean displacement needs no more.
    var features = 800
    /// Frames measured at a time. Chosen.
    var batch = 32

    init() {}
  }

  var options = Options()

  /// The readings of the frames of `video`, which has been opened and not been read.
  func run(_ video: VideoFile, _ control: KernelControl) throws -> [FrameReading] {
    let duration = video.duration ?? 0
    var motion: FrameMotion?
    var readings: [FrameReading] = []
    var frames: [Frame] = []
    func measure() throws {
      let measured = try control.withoutProgress.parallelMap(draining: &frames) { _, frame in
        try self.measure(frame)
      }
      for frame in measured {
        var path =
          motion
          ?? FrameMotion(
            width: frame.width, height: frame.height, duration: duration)
        readings.append(
          FrameReading(
            index: frame.index, seconds: frame.seconds,
            position: try path.advance(frame.features, at: frame.seconds),
            sharpness: frame.sharpness))
        motion = path
      }
    }
    var index = 0
    var next = -Double.infinity
    while let seconds = try video.next() {
      if seconds >= next {
        next = seconds + (1 - Self.slack) / options.framesPerSecond
        frames.append(
          Frame(
            index: index, seconds: seconds,
            brightness: try video.brightness(longerSide: options.sharpnessSide)))
        if frames.count == options.batch { try measure() }
        try control.step(duration > 0 ? min(1, max(0, seconds / duration)) : 0)
      }
      index += 1
    }
    try measure()
    return readings
  }

  /// Share of the interval by which a frame may come early: times are rounded. Chosen.
  private static let slack = 0.05

  private struct Frame: Sendable {
    var index: Int
    var seconds: Double
    var brightness: RasterImage
  }

  private struct MeasuredFrame: Sendable {
    var index: Int
    var seconds: Double
    var width: Int
    var height: Int
    var features: FeatureSet
    var sharpness: Double
  }

  private func measure(_ frame: Frame) throws -> MeasuredFrame {
    let full = frame.brightness
    let factor = min(1, Double(options.featureSide) / Double(max(full.width, full.height)))
    let small = try full.resized(
      width: max(1, Int(Double(full.width) * factor)),
      height: max(1, Int(Double(full.height) * factor)))
    var detection = FeatureDetection()
    detection.maximumFeatures = options.features
    detection.doublesPhoto = false
    return MeasuredFrame(
      index: frame.index, seconds: frame.seconds, width: small.width, height: small.height,
      features: try detection.features(in: small, KernelControl()),
      sharpness: try sharpness(full))
  }

  private func sharpness(_ image: RasterImage) throws -> Double {
    do {
      return try image.sharpness()
    } catch KernelError.degenerate {
      return 0
    }
  }
}
