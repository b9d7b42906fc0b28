import Testing

@testable import SharedCommands

@Suite struct DetailArgumentsTests {
  @Test func customLimitsAreParsed() throws {
    let custom = try DetailArguments.parse([
      "-d", "custom", "--max-polygons", "12000", "--texture-side", "2048",
      "--maps", "color,occlusion", "--texture-format", "jpeg:0.5",
    ])
    #expect(custom.detail == .custom)
    #expect(custom.specification.maximumPolygonCount == 12_000)
    #expect(custom.specification.maximumTextureDimension == .twoK)
    #expect(custom.specification.outputTextureMaps == [.diffuseColor, .ambientOcclusion])
    #expect(custom.specification.textureFormat == .jpeg(compressionQuality: 0.5))
    let plain = try DetailArguments.parse(["-d", "custom"])
    #expect(plain.specification == CustomDetail())
  }

  @Test func coarserLevelsAreThoseBelow() throws {
    #expect(try DetailArguments.parse(["--lod"]).coarserLevels == [.preview])
    #expect(
      try DetailArguments.parse(["--lod", "-d", "full"]).coarserLevels
        == [.preview, .reduced, .medium])
    #expect(try DetailArguments.parse(["-d", "full"]).coarserLevels.isEmpty)
  }

  @Test(arguments: [
    ["--max-polygons", "12000"], ["-d", "medium", "--texture-side", "2048"],
    ["-d", "custom", "--texture-side", "2000"], ["-d", "custom", "--max-polygons", "0"],
    ["-d", "custom", "--maps", "color,gloss"], ["-d", "custom", "--maps", ""],
    ["-d", "custom", "--texture-format", "jpeg:2"], ["-d", "custom", "--texture-format", "exr"],
    ["-d", "custom", "--lod"], ["-d", "preview", "--lod"],
  ])
  func invalidLimitsAreRejected(_ arguments: [String]) {
    #expect(throws: (any Error).self) { try DetailArguments.parse(arguments) }
  }
}
