import Formats
import ImageFiles
import Kernels
import SceneModel
import TestFiles
import Testing

@testable import Evaluation

@Suite struct OutlineComparisonTests {
  private static let control = KernelControl(threadCount: 2)

  private static func mask(width: Int, height: Int, columns: Range<Int>) throws -> [UInt8] {
    var mask = RasterImage(width: width, height: height, channels: 1)
    for index in mask.pixels.indices where columns.contains(index % width) {
      mask.pixels[index] = 255
    }
    return try ImageCodec.encodePNG(mask)
  }

  private static var options: OutlineComparison.Options {
    var options = OutlineComparison.Options()
    options.maximumWidth = 40
    return options
  }

  /// The model covers columns 10 to 29 of 40, the mask columns 12 to 31 of the full size.
  @Test func sharesAreExact() throws {
    var part = LoadedModel.Part()
    part.positions = [[-0.5, -9, 1], [0.5, -9, 1], [0.5, 9, 1], [-0.5, 9, 1]]
    part.triangles = [Triangle(0, 2, 1), Triangle(0, 3, 2)]
    let model = try ShadedModel(LoadedModel(parts: [part]), .identity, Self.control)
    let camera = NamedCamera(
      name: "000007.jpg", camera: Camera(width: 80, height: 40, focalLength: [40, 40]),
      cameraFromWorld: .identity)
    let folder = try TemporaryFolder()
    try folder.write(try Self.mask(width: 80, height: 40, columns: 24..<64), as: "7-mask.png")
    let scores = try #require(
      try OutlineComparison(Self.options, Self.control).run(
        model, [camera], MaskFolder(folder.url)))
    #expect(scores.photos.count == 1)
    #expect(abs(scores.intersectionOverUnion - 18.0 / 22) < 1e-9)
    #expect(abs(scores.outside - 0.1) < 1e-9)
    #expect(abs(scores.missing - 0.1) < 1e-9)
    #expect(scores.worst == "000007.jpg")
  }

  @Test func foldersOfMasksAreCompared() throws {
    let (found, truth) = (try TemporaryFolder(), try TemporaryFolder())
    try found.write(try Self.mask(width: 40, height: 20, columns: 0..<20), as: "a.png")
    try truth.write(try Self.mask(width: 40, height: 20, columns: 0..<20), as: "a_mask.png")
    try found.write(try Self.mask(width: 40, height: 20, columns: 0..<20), as: "b.png")
    try truth.write(try Self.mask(width: 40, height: 20, columns: 0..<10), as: "b_mask.png")
    // Empty masks and masks without a counterpart don't count.
    try found.write(try Self.mask(width: 40, height: 20, columns: 0..<20), as: "c.png")
    try truth.write(try Self.mask(width: 40, height: 20, columns: 0..<0), as: "c_mask.png")
    try found.write(try Self.mask(width: 40, height: 20, columns: 0..<20), as: "d.png")
    let scores = try #require(
      try OutlineComparison(Self.options, Self.control).run(
        MaskFolder(found.url), MaskFolder(truth.url)))
    #expect(scores.photos.map(\.name) == ["a.png", "b.png"])
    #expect(scores.photos.map(\.intersectionOverUnion) == [1, 0.5])
    #expect(scores.medianIntersectionOverUnion == 0.75)
    #expect(scores.minimumIntersectionOverUnion == 0.5)
  }
}
