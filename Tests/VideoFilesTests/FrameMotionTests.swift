import Kernels
import SceneModel
import TestSupport
import Testing

@testable import VideoFiles

@Suite struct FrameMotionTests {
  private let width = 640
  private let height = 360
  private var diagonal: Double { Double(width * width + height * height).squareRoot() }

  /// Noise with structures of a few pixels.
  private func texture(width: Int, height: Int, seed: UInt64) throws -> RasterImage {
    var random = SplitMix64(seed: seed)
    var small = RasterImage(width: width / 4, height: height / 4, channels: 1)
    for index in small.pixels.indices { small.pixels[index] = UInt8(random.below(256)) }
    return try small.resized(width: width, height: height)
  }

  private func features(_ image: RasterImage) throws -> FeatureSet {
    var detection = FeatureDetection()
    detection.maximumFeatures = 800
    return try detection.features(in: image, KernelControl())
  }

  private func positions(_ frames: [RasterImage], duration: Double) throws -> [Double] {
    var motion = FrameMotion(width: width, height: height, duration: duration)
    return try frames.enumerated().map {
      try motion.advance(features($1), at: duration * Double($0) / Double(frames.count))
    }
  }

  /// The part of a large image that starts at `x`.
  private func window(_ image: RasterImage, at x: Int) -> RasterImage {
    var result = RasterImage(width: width, height: height, channels: 1)
    for row in 0..<height {
      for column in 0..<width {
        result.pixels[row * width + column] = image.pixels[row * image.width + x + column]
      }
    }
    return result
  }

  @Test func aPanIsAsLongAsItsPath() throws {
    let scene = try texture(width: 1040, height: height, seed: 3)
    let frames = (0..<50).map { window(scene, at: 8 * $0) }
    let length = try #require(try positions(frames, duration: 5).last)
    #expect(abs(length * diagonal / (8 * 49) - 1) < 0.03)
  }

  @Test func jitterDoesNotAddUp() throws {
    let scene = try texture(width: 680, height: height, seed: 4)
    let frames = (0..<120).map { window(scene, at: 20 + $0 % 2) }
    let length = try #require(try positions(frames, duration: 10).last)
    #expect(length == 0)
  }

  @Test func anObjectThatTurnsInAStillPictureCounts() throws {
    let wall = try texture(width: width, height: height, seed: 5)
    let object = try texture(width: 1200, height: height, seed: 6)
    let frames = (0..<80).map { index in
      var frame = wall
      for row in 80..<280 {
        for column in 200..<440 {
          frame.pixels[row * width + column] =
            object.pixels[row * object.width + column + 9 * index]
        }
      }
      return frame
    }
    let result = try positions(frames, duration: 5)
    let half = result[40], all = try #require(result.last)
    #expect(all * diagonal > 20 && abs(half / all - 0.5) < 0.15)
  }

  @Test func aCutIsOneStep() throws {
    let frames = try (0..<2).map { try texture(width: width, height: height, seed: 7 + $0) }
    #expect(try positions(frames, duration: 1) == [0, FrameMotion.Options().unknownDistance])
  }

  @Test func picturesWithoutTextureDoNotFail() throws {
    let plain = RasterImage(width: width, height: height, channels: 1, filledWith: 90)
    #expect(try positions([plain, plain, plain], duration: 1).allSatisfy(\.isFinite))
  }
}
