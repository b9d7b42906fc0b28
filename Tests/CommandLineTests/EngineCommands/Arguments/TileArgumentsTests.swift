import Foundation
import TestFiles
import TestLevels
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct TileArgumentsTests {
  private struct Index: Decodable {
    struct Tile: Decodable {
      var file: String
      var triangles: Int
    }
    var tiles: [Tile]
  }

  @Test func tilesAreGLBUnlessChosen() throws {
    let folder = try TemporaryFolder()
    let path = folder.url.appendingPathComponent("tiles").path
    #expect(try TileArguments.parse([]).output() == nil)
    #expect(try TileArguments.parse(["--tiles", path]).output()?.fileExtension == "glb")
    let usdz = try TileArguments.parse(["--tiles", path, "--tile-format", "usdz"])
    #expect(try usdz.output()?.fileExtension == "usdz")
  }

  /// A second run leaves no tiles of the first.
  @Test(.endToEnd) func theIndexListsTheTiles() throws {
    let folder = try TemporaryFolder()
    let tiles = folder.url.appendingPathComponent("tiles")
    let photos = folder.url.appendingPathComponent("photos")
    try FileManager.default.createDirectory(at: photos, withIntermediateDirectories: true)
    let source = Fixtures.images(of: "orbit")
    for name in try FileManager.default.contentsOfDirectory(atPath: source.path).sorted().prefix(8)
    {
      try FileManager.default.copyItem(
        at: source.appendingPathComponent(name), to: photos.appendingPathComponent(name))
    }
    func run(_ options: [String]) throws -> [Index.Tile] {
      let run = try CommandProcess.run(
        [
          "reconstruct", "photos", "m.usdz", "-d", "preview",
          "--no-object-masking", "--checkpoint-directory", "work", "--tiles", "tiles",
          "--set", "meshGeneration.trimming.boundary.steps=8",
          "--set", "meshGeneration.trimming.boundary.reach=4", "--set", "tiling.textureSide=512",
        ] + options, in: folder.url)
      #expect(run.exitCode == 0, "\(run.errors)")
      let data = try Data(contentsOf: tiles.appendingPathComponent("tiles.json"))
      return try JSONDecoder().decode(Index.self, from: data).tiles
    }
    let several = try run(["--set", "tiling.maximumPoints=8000"])
    #expect(several.count > 1 && several.allSatisfy { $0.triangles > 0 })
    let one = try run(["--set", "tiling.maximumPoints=1000000"])
    let files = try FileManager.default.contentsOfDirectory(atPath: tiles.path)
    #expect(one.count == 1 && Set(files) == ["tiles.json", "tile-0001.glb"])
  }
}
