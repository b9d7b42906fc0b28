import Formats
import Foundation
import TestSupport
import Testing

@testable import SharedCommands

@Suite struct ModelOutputTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  @Test func extensionSelectsTheFormat() throws {
    let path = temporary.url.path
    for format in ModelFormat.files {
      let file = try ModelOutput(path + "/m.\(format.rawValue)", formats: ModelFormat.files)
      #expect(file.format == format)
      #expect(file.url == URL(fileURLWithPath: path + "/m.\(format.rawValue)", isDirectory: false))
    }
    for name in ["/new", "/new.v2/", "", "/ü 模型", "/..."] {
      let output = try ModelOutput(path + name, formats: ModelFormat.files)
      #expect(output.url.hasDirectoryPath)
      #expect(output.format == .folder, "\(name)")
    }
    #expect(
      try ModelOutput(path + "/M.USDZ", formats: ModelFormat.files).url.lastPathComponent
        == "M.USDZ")
    #expect(try ModelOutput(path + "/M.Glb", formats: ModelFormat.files).format == .glb)
    for name in ["/m.obj", "/m.txt", "/no/such/m.usdz", "/m.usdz/", "/m.glb/", "/.usdz", "/.ply"] {
      let failure = #expect(throws: CommandFailure.self, "\(name)") {
        try ModelOutput(path + name, formats: ModelFormat.files)
      }
      #expect(failure?.exitCode == 2)
    }
    #expect(throws: CommandFailure.self) { try ModelOutput("", formats: ModelFormat.files) }
    try temporary.write("", as: "plain")
    #expect(throws: CommandFailure.self) {
      try ModelOutput(path + "/plain", formats: ModelFormat.files)
    }
  }
}
