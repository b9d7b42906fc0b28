import Formats
import Foundation
import TestSupport
import Testing

@testable import SharedCommands

@Suite struct CoarserModelTests {
  private func models(_ path: String, _ arguments: [String]) throws -> [CoarserModel] {
    try CoarserModel.all(
      try DetailArguments.parse(arguments),
      nextTo: try ModelOutput(path, formats: ModelFormat.files))
  }

  @Test func filesAreNamedAfterTheirLevel() throws {
    let folder = try TemporaryFolder()
    let models = try models(folder.url.path + "/a.b.usdz", ["--lod", "-d", "medium"])
    #expect(models.map(\.level) == [.preview, .reduced])
    #expect(models.map(\.output.url.lastPathComponent) == ["a.b-preview.usdz", "a.b-reduced.usdz"])
    #expect(models.allSatisfy { $0.output.format == .usdz })
    #expect(try self.models(folder.url.path + "/a.usdz", ["-d", "medium"]).isEmpty)
  }

  @Test func relativePathsStayRelative() throws {
    let models = try models("m.glb", ["--lod"])
    #expect(models.map(\.output.url.relativePath) == ["m-preview.glb"])
  }

  @Test func foldersAreRejected() throws {
    let folder = try TemporaryFolder()
    #expect { try models(folder.url.path + "/model/", ["--lod"]) } throws: {
      CommandFailure($0).sentence.contains("--lod")
    }
    // One of the files is taken by a folder.
    let taken = folder.url.appendingPathComponent("m-preview.usdz", isDirectory: true)
    try FileManager.default.createDirectory(at: taken, withIntermediateDirectories: false)
    #expect { try models(folder.url.path + "/m.usdz", ["--lod"]) } throws: {
      CommandFailure($0).sentence.contains("m-preview.usdz is a folder")
    }
  }
}
