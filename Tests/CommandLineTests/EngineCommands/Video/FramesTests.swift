import Foundation
import ImageFiles
import SharedCommands
import TestLevels
import TestSupport
import Testing
import VideoFiles

@testable import EngineCommands

/// Why the tests that read videos are left out.
private let missing: String? =
  VideoWriter.program == nil ? "the program ffmpeg is not installed" : VideoSupport.current.remedy

@Suite struct VideoInputTests {
  @Test func whatIsNoPhotoIsAVideo() throws {
    let temporary = try TemporaryFolder()
    try temporary.writeNoisePhotos(1, to: "photos")
    let path = temporary.url.path
    let name = try #require(
      try FileManager.default.contentsOfDirectory(atPath: path + "/photos").first)
    try temporary.write("x", as: "clip.mov")
    #expect(
      try PipelineEngine.input(path + "/photos")
        == .folder(URL(fileURLWithPath: path + "/photos", isDirectory: true)))
    #expect(
      try PipelineEngine.input(path + "/clip.mov")
        == .video(URL(fileURLWithPath: path + "/clip.mov")))
    for wrong in ["/photos/\(name)", "/none.mov"] {
      #expect(throws: CommandFailure.self) { try PipelineEngine.input(path + wrong) }
    }
  }
}

@Suite(.endToEnd, .enabled(if: missing == nil, "\(missing ?? "")")) struct FramesTests {
  private let temporary: TemporaryFolder

  init() throws {
    temporary = try TemporaryFolder()
    let folder = Fixtures.images(of: "orbit")
    let photos = try FileManager.default.contentsOfDirectory(atPath: folder.path).sorted().map {
      try ImageCodec.decode(ImageCodec.contents(of: folder.appendingPathComponent($0)))
    }
    var writer = VideoWriter()
    writer.framesPerSecond = 4
    try writer.write(
      to: temporary.url.appendingPathComponent("clip.mp4"), width: photos[0].width,
      height: photos[0].height, count: photos.count
    ) { photos[$0] }
  }

  private func names(_ folder: String) throws -> [String] {
    try FileManager.default.contentsOfDirectory(
      atPath: temporary.url.appendingPathComponent(folder).path
    ).sorted()
  }

  @Test func framesAreSaved() throws {
    let run = try CommandProcess.run(
      ["frames", "clip.mp4", "photos", "--frames", "8"], in: temporary.url)
    #expect(run.exitCode == 0 && run.output == "photos\n", "\(run.errors)")
    #expect(run.errors.contains("8 of "), "\(run.errors)")
    #expect(try names("photos").count == 8)
    #expect(try names(".") == ["clip.mp4", "photos"])
    try CommandProcess.expectFailure(
      ["frames", "clip.mp4", "photos"], in: temporary.url, code: 2,
      mentioning: ["photos exists already"])
    try CommandProcess.expectFailure(
      ["frames", "photos", "other"], in: temporary.url, code: 2, mentioning: ["is a folder"])
    try CommandProcess.expectFailure(
      ["frames", "clip.mp4", "x", "--frames", "2"], in: temporary.url, code: 2,
      mentioning: ["from 3 to 1000"])
  }

  @Test func filesThatAreNoVideosFail() throws {
    try temporary.write("This is not a video.", as: "notes.txt")
    for command in [["notes.txt", "m.usdz"], ["frames", "notes.txt", "photos"]] {
      try CommandProcess.expectFailure(
        command, in: temporary.url, code: 1, mentioning: ["notes.txt: it can't be read as a video"])
    }
    #expect(try names(".") == ["clip.mp4", "notes.txt"])
  }

  /// A run reads the frames that `frames` saves, keeps them in the checkpoint, and uses them again.
  @Test func modelsAreMadeOfVideos() throws {
    let run = try CommandProcess.run(
      ["clip.mp4", "a.usdz", "-d", "preview", "--checkpoint-directory", "work"],
      in: temporary.url)
    #expect(run.exitCode == 0, "\(run.errors)")
    #expect(FrameRecord(file: temporary.url.appendingPathComponent("work/frames.json")) != nil)
    let again = try CommandProcess.run(
      ["clip.mp4", "b.usdz", "-d", "preview", "--checkpoint-directory", "work"],
      in: temporary.url)
    #expect(again.exitCode == 0 && !again.errors.contains("choosing frames"), "\(again.errors)")
    let saved = try CommandProcess.run(["frames", "clip.mp4", "photos"], in: temporary.url)
    #expect(saved.exitCode == 0)
    #expect(try names("photos") == names("work/frames"))
    let photos = try CommandProcess.run(["photos", "c.usdz", "-d", "preview"], in: temporary.url)
    #expect(photos.exitCode == 0, "\(photos.errors)")
    let models = try ["a", "b", "c"].map {
      try Data(contentsOf: temporary.url.appendingPathComponent("\($0).usdz"))
    }
    #expect(models[0] == models[1] && models[0] == models[2])
  }
}
