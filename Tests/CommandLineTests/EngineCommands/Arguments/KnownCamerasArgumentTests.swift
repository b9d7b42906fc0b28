import Foundation
import SharedCommands
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct KnownCamerasArgumentTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private func cameras(_ folder: String, isMetric: Bool = false) throws -> KnownCamerasArgument {
    try KnownCamerasArgument(temporary.url.path + "/" + folder, isMetric: isMetric)
  }

  private func writeSparse(_ folder: String) throws {
    try temporary.write("1 SIMPLE_PINHOLE 420 316 462 210 158\n", as: folder + "/cameras.txt")
    try temporary.write("1 1 0 0 0 0 0 0 1 a.jpg\n\n", as: folder + "/images.txt")
  }

  @Test(arguments: ["rig", "rig/sparse", "rig/sparse/0"])
  func camerasFromCOLMAPAreFound(_ place: String) throws {
    try writeSparse(place)
    let reconstruction = try cameras("rig").cameras.reconstruction
    #expect(reconstruction.cameras.map(\.width) == [420])
    #expect(reconstruction.photos.map(\.name) == ["a.jpg"])
    #expect(reconstruction.worldFrame.scale != .given)
  }

  @Test func metricCamerasGiveTheScale() throws {
    try writeSparse("rig")
    #expect(try cameras("rig", isMetric: true).cameras.reconstruction.worldFrame.scale == .given)
  }

  @Test func camerasWithoutSizeAreMarked() throws {
    let entry =
      #""K": [[9, 0, 5], [0, 9, 4], [0, 0, 1]], "R": [[1,0,0],[0,1,0],[0,0,1]], "t": [0,0,0]"#
    try temporary.write(
      #"[{"name": "a.jpg", \#(entry)}, {"name": "b.jpg", \#(entry), "width": 10, "height": 8}]"#,
      as: "rig/cameras.json")
    let known = try cameras("rig").cameras
    #expect(known.reconstruction.photos.map(\.name) == ["a.jpg", "b.jpg"])
    #expect(known.photosOfUnknownSize.map(\.index) == [0])
  }

  @Test func foldersWithoutCamerasAreInvalid() throws {
    try temporary.write("", as: "empty/x")
    try temporary.write("", as: "binary/sparse/images.bin")
    for (folder, words) in [
      ("none", "does not exist"), ("empty/x", "is a file"), ("empty", "holds no cameras"),
      ("binary", "cameras.bin can't be read"),
    ] {
      let failure = #expect(throws: CommandFailure.self, "\(folder)") { try cameras(folder) }
      #expect(failure?.exitCode == 2 && failure?.sentence.contains(words) == true, "\(folder)")
    }
  }
}
