import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import VideoFiles

@Suite(.enabled(if: missing == nil, "\(missing ?? "")")) struct VideoFramesTests {
  /// A second of a walk around the statue, at a speed at which frames differ.
  private func clip(in folder: URL) throws -> URL {
    var video = WalkAroundVideo(seed: 2)
    (video.width, video.height) = (240, 136)
    (video.seconds, video.framesPerSecond, video.samples) = (3, 12, 1)
    let url = folder.appendingPathComponent("walk.mp4")
    var writer = VideoWriter()
    writer.framesPerSecond = video.framesPerSecond
    try writer.write(
      to: url, width: video.width, height: video.height, count: video.frameCount
    ) { try video.frame($0, KernelControl(threadCount: 2)) }
    return url
  }

  private func photos(
    _ url: URL, count: Int?, _ control: KernelControl
  ) throws -> (photos: [VideoFrames.Photo], summary: VideoFrames.Summary) {
    var options = VideoFrames.Options()
    options.count = count
    var photos: [VideoFrames.Photo] = []
    let summary = try VideoFrames(options).run(url, control) { photos.append($0) }
    return (photos, summary)
  }

  @Test func photosDoNotDependOnThreads() throws {
    try withTemporaryFolder { folder in
      let url = try clip(in: folder)
      let one = try photos(url, count: 12, KernelControl(threadCount: 1))
      let three = try photos(url, count: 12, KernelControl(threadCount: 3))
      #expect(one.photos.map(\.jpeg) == three.photos.map(\.jpeg))
      #expect(one.photos.count == 12 && one.summary == three.summary)
      #expect(one.photos.map(\.name) == one.photos.map(\.name).sorted())
      #expect(one.photos[0].name.wholeMatch(of: /walk_0000\.\d\d\d\.jpg/) != nil)
      #expect(try ImageHeader(one.photos[0].jpeg).width == 240)
      #expect(PhotoMetadata(one.photos[0].jpeg).make == "Video")
    }
  }

  @Test func aShortVideoGivesAllItsFrames() throws {
    try withTemporaryFolder { folder in
      let result = try photos(clip(in: folder), count: nil, KernelControl(threadCount: 2))
      #expect(result.photos.count == result.summary.photos)
      #expect((18...36).contains(result.photos.count) && result.summary.examined == 36)
    }
  }

  @Test func cancellationStops() throws {
    try withTemporaryFolder { folder in
      let url = try clip(in: folder)
      let flag = CancellationFlag()
      let control = KernelControl(threadCount: 1, flag: flag) { if $0 > 0.3 { flag.cancel() } }
      #expect(throws: CancellationError.self) { try photos(url, count: nil, control) }
    }
  }

  @Test func tooFewFramesAreAnError() throws {
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("two.mp4")
      var writer = VideoWriter()
      writer.framesPerSecond = 10
      try writer.write(to: url, width: 64, height: 48, count: 2) {
        RasterImage(width: 64, height: 48, channels: 3, filledWith: UInt8(100 + 50 * $0))
      }
      #expect(throws: VideoError.tooFewFrames(2)) {
        try photos(url, count: nil, KernelControl())
      }
    }
  }
}
