import Evaluation
import Formats
import Foundation
import RealityKit
import TestSupport
import Testing

@testable import photogrammetry_cli

@Suite struct ParsingTests {
  @Test func oldCommandLinesWork() throws {
    let command = try PhotogrammetryCLI.parseAsRoot([
      "photos", "model.usdz", "-d", "medium", "-o", "sequential", "-f", "high",
    ])
    let reconstruct = try #require(command as? Reconstruct)
    #expect(reconstruct.inputFolder == "photos")
    #expect(reconstruct.output == "model.usdz")
    #expect(reconstruct.detail.detail == .level(.medium))
    #expect(reconstruct.alignment.sampleOrdering == .sequential)
    #expect(reconstruct.alignment.featureSensitivity == .high)
    #expect(!reconstruct.noObjectMasking)
  }

  @Test func defaultsAreApples() throws {
    let reconstruct = try Reconstruct.parse(["a", "b.usdz"])
    #expect(reconstruct.detail.detail == .level(.reduced))
    #expect(reconstruct.alignment.sampleOrdering == .unordered)
    #expect(reconstruct.alignment.featureSensitivity == .normal)
    #expect(reconstruct.engine.threads == nil)
  }

  @Test func allOptions() throws {
    let reconstruct = try Reconstruct.parse([
      "a", "b/", "--detail", "raw", "--checkpoint-directory", "ck", "--poses", "p.json",
      "--point-cloud", "c.ply", "--report", "r.json", "--no-object-masking", "--threads", "2",
      "--json", "--verbose",
    ])
    #expect(reconstruct.checkpointDirectory == "ck")
    #expect(reconstruct.poses == "p.json")
    #expect(reconstruct.pointCloud == "c.ply")
    #expect(reconstruct.engine.report == "r.json")
    #expect(reconstruct.engine.threads == 2)
    #expect(reconstruct.noObjectMasking && reconstruct.json && reconstruct.logging.verbose)
  }

  @Test func boxesAndFaces() throws {
    let shape = try Reconstruct.parse([
      "a", "b.usdz", "--crop", "-1,0.5,2,1,-2, 3e-1", "--quads",
    ]).shape
    #expect(shape.geometry?.bounds == BoundingBox(min: [-1, -2, 0.3], max: [1, 0.5, 2]))
    #expect(shape.primitive == .quad)
    let plain = try Reconstruct.parse(["a", "b.usdz"]).shape
    #expect(plain.geometry == nil && plain.primitive == .triangle)
    for wrong in ["1,2,3", "0,0,0,1,1,0", "0,0,0,1,1,x", "0,0,0,1,1,nan", "0,0,0,1,1,1,1"] {
      #expect(throws: (any Error).self) { try Reconstruct.parse(["a", "b", "--crop", wrong]) }
    }
  }

  @Test func customBounds() throws {
    let custom = try Reconstruct.parse([
      "a", "b.usdz", "-d", "custom", "--max-polygons", "12000", "--texture-side", "2048",
      "--maps", "color,occlusion", "--texture-format", "jpeg:0.5",
    ]).detail
    #expect(custom.detail == .custom)
    #expect(custom.specification.maximumPolygonCount == 12_000)
    #expect(custom.specification.maximumTextureDimension == .twoK)
    #expect(custom.specification.outputTextureMaps == [.diffuseColor, .ambientOcclusion])
    #expect(custom.specification.textureFormat == .jpeg(compressionQuality: 0.5))
    let plain = try Reconstruct.parse(["a", "b.usdz", "-d", "custom"]).detail
    #expect(plain.specification == DetailArguments.Specification())
  }

  @Test(arguments: [
    ["--max-polygons", "12000"], ["-d", "medium", "--texture-side", "2048"],
    ["-d", "custom", "--texture-side", "2000"], ["-d", "custom", "--max-polygons", "0"],
    ["-d", "custom", "--maps", "color,gloss"], ["-d", "custom", "--maps", ""],
    ["-d", "custom", "--texture-format", "jpeg:2"], ["-d", "custom", "--texture-format", "exr"],
  ])
  func wrongCustomBoundsAreRefused(_ arguments: [String]) {
    #expect(throws: (any Error).self) { try Reconstruct.parse(["a", "b.usdz"] + arguments) }
  }

  @Test(arguments: [
    ["a"], ["a", "b.usdz", "c"], ["a", "b.usdz", "-d", "huge"], ["a", "b.usdz", "--threads", "0"],
    ["a", "b.usdz", "--threads", "x"], ["a", "b.usdz", "--quiet", "--verbose"],
    ["a", "b.usdz", "--unknown"],
  ])
  func wrongArgumentsAreRefused(_ arguments: [String]) {
    #expect(throws: (any Error).self) { try Reconstruct.parse(arguments) }
  }

  @Test func knownDistances() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    for name in ["a=1.jpg", "b.jpg"] { try Data().write(to: folder.appendingPathComponent(name)) }
    let file = folder.appendingPathComponent("points.json")
    try Data(
      """
      [{"meters": 0.2, "from": [{"photo": "a=1.jpg", "x": 1, "y": 2}, {"photo": "b.jpg", "x": 3, "y": 4}],
        "to": [{"photo": "a=1.jpg", "x": 5, "y": 6}, {"photo": "b.jpg", "x": 7, "y": 8}]}]
      """.utf8
    ).write(to: file)
    let command = try Reconstruct.parse([
      "a", "b.usdz", "--camera-distance", "a=1.jpg, b.jpg=0.42", "--measurements", file.path,
    ])
    let distances = try command.engine.knownDistances(photos: folder)
    #expect(distances.count == 2 && distances.map(\.meters) == [0.42, 0.2])
    #expect(distances[0].from == .camera("a=1.jpg") && distances[0].to == .camera("b.jpg"))
    let far = try Reconstruct.parse(["a", "b.usdz", "--camera-distance", "a=1.jpg,c.jpg=1"])
    let failure = #expect(throws: CommandFailure.self) {
      try far.engine.knownDistances(photos: folder)
    }
    #expect(failure?.exitCode == 2 && failure?.sentence.contains("c.jpg") == true)
    _ = temporary
  }

  @Test(arguments: ["a.jpg=1", "a.jpg,b.jpg", "a.jpg,b.jpg=0", "a.jpg,a.jpg=1", "a.jpg,b.jpg=x"])
  func wrongCameraDistancesAreRefused(_ argument: String) {
    #expect(throws: (any Error).self) {
      try Reconstruct.parse(["a", "b.usdz", "--camera-distance", argument])
    }
  }

  @Test(arguments: [
    "", "{}", "[]", #"[{"meters": 0, "from": [], "to": []}]"#,
    #"[{"meters": 1, "from": [{"photo": "a", "x": 1, "y": 1}], "to": []}]"#,
  ])
  func wrongMeasurementsAreRefused(_ text: String) throws {
    let temporary = try TemporaryFolder()
    let file = temporary.url.appendingPathComponent("m.json")
    try Data(text.utf8).write(to: file)
    let failure = #expect(throws: CommandFailure.self) { try MeasurementFile(file.path) }
    #expect(failure?.exitCode == 2 && failure?.sentence.contains("m.json") == true)
    _ = temporary
  }

  @Test func subcommands() throws {
    #expect(try PhotogrammetryCLI.parseAsRoot(["inspect", "photos"]) is Inspect)
    let evaluate = try #require(
      try PhotogrammetryCLI.parseAsRoot([
        "evaluate", "ck", "--reference", "gt", "--threshold", "0.1", "0.2", "--floor", "z=-0.5",
      ]) as? Evaluate)
    #expect(evaluate.threshold == [0.1, 0.2])
    #expect(evaluate.floor == Floor(axis: 2, height: -0.5))
    for option in [
      ["--floor", "0.1"], ["--floor", "w=1"], ["--floor", "z=nan"], ["--voxel", "inf"],
    ] {
      #expect(throws: (any Error).self) {
        try Evaluate.parse(["ck", "--reference", "gt"] + option)
      }
    }
    #expect(throws: (any Error).self) {
      try Evaluate.parse(["ck", "--reference", "gt", "--threshold", "-1"])
    }
  }

  @Test func outputsByName() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    let path = folder.path
    for format in ModelFormat.files {
      let file = try ModelOutput(path + "/m.\(format.rawValue)")
      #expect(file.format == format)
      #expect(file.url == URL(fileURLWithPath: path + "/m.\(format.rawValue)", isDirectory: false))
    }
    for name in ["/new", "/new.v2/", "", "/ü 模型", "/..."] {
      let output = try ModelOutput(path + name)
      #expect(output.url.hasDirectoryPath)
      #expect(output.format == .folder, "\(name)")
    }
    #expect(try ModelOutput(path + "/M.USDZ").url.lastPathComponent == "M.USDZ")
    #expect(try ModelOutput(path + "/M.Glb").format == .glb)
    for name in ["/m.obj", "/m.txt", "/no/such/m.usdz", "/m.usdz/", "/m.glb/", "/.usdz", "/.ply"] {
      let failure = #expect(throws: CommandFailure.self, "\(name)") {
        try ModelOutput(path + name)
      }
      #expect(failure?.exitCode == 2)
    }
    #expect(throws: CommandFailure.self) { try ModelOutput("") }
    try Data().write(to: folder.appendingPathComponent("plain"))
    #expect(throws: CommandFailure.self) { try ModelOutput(path + "/plain") }
    _ = temporary
  }
}
