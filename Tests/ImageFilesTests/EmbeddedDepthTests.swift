import DamagedInput
import ImageFiles
import SceneModel
import TestSupport
import Testing

@Suite struct EmbeddedDepthTests {
  /// A gray photo whose map increases smoothly to the right, and by half of that downward.
  private func file(
    width: Int = 96, height: Int = 64, _ description: DepthHEICWriter.Description,
    orientation: Int = 1
  ) throws -> [UInt8] {
    let photo = RasterImage(width: width, height: height, channels: 3, filledWith: 90)
    var content = ImageCodec.HEICContent()
    content.orientation = orientation
    content.quality = 1
    return try DepthHEICWriter.file(
      photo, samples: Self.samples(width: width, height: height), description, content)
  }

  private static func samples(width: Int, height: Int) -> [UInt8] {
    (0..<height).flatMap { y in
      (0..<width).map { x in
        UInt8(64 + 100 * x / width + 50 * y / height)
      }
    }
  }

  private func map(_ bytes: [UInt8]) throws -> DepthMap {
    guard case .metric(let map) = EmbeddedDepth(bytes) else {
      throw ImageError.damaged("no depth map")
    }
    return map
  }

  /// The largest relative difference to a map of the stored samples, turned upright.
  private func deviation(
    _ map: DepthMap, orientation: Int, _ value: (Float) -> Float
  ) throws -> Float {
    let depths = Self.samples(width: 96, height: 64).map { value(Float($0) / 255) }
    let expected = try #require(DepthMap(width: 96, height: 64, depths: depths))
      .turned(byOrientation: orientation)
    try #require((map.width, map.height) == (expected.width, expected.height))
    return zip(map.depths, expected.depths).map { abs($0 / $1 - 1) }.max() ?? 1
  }

  @Test(arguments: 1...8) func disparitiesBecomeDepthsOfTheUprightPhoto(orientation: Int) throws {
    var description = DepthHEICWriter.Description()
    description.range = (0.2, 2.2)
    let map = try map(file(description, orientation: orientation))
    #expect(!map.mayBeDisparities)
    #expect(try deviation(map, orientation: orientation) { 1 / (0.2 + 2 * $0) } < 0.03)
  }

  @Test(arguments: [false, true]) func depthsAreKept(usesAttributes: Bool) throws {
    var description = DepthHEICWriter.Description()
    description.kind = "depth"
    description.range = (1, 5)
    description.usesAttributes = usesAttributes
    #expect(try deviation(map(file(description)), orientation: 1) { 1 + 4 * $0 } < 0.03)
  }

  @Test func mapsWithoutAScaleAreRelative() throws {
    var description = DepthHEICWriter.Description()
    description.accuracy = "relative"
    #expect(EmbeddedDepth(try file(description)) == .relative)
    description.accuracy = ""
    #expect(EmbeddedDepth(try file(description)) == .relative)
    description.accuracy = "absolute"
    description.range = (1, 1)
    #expect(EmbeddedDepth(try file(description)) == nil)
    description.range = (0, .infinity)
    #expect(EmbeddedDepth(try file(description)) == nil)
    description.range = (0, 2)
    description.kind = "portraiteffectsmatte"
    #expect(EmbeddedDepth(try file(description)) == nil)
  }

  @Test func otherFilesHaveNoMap() throws {
    let image = RasterImage(width: 64, height: 64, channels: 4, filledWith: 90)
    #expect(EmbeddedDepth(try ImageCodec.encodeHEIC(image)) == nil)
    #expect(EmbeddedDepth(try ImageCodec.encodePNG(image)) == nil)
    #expect(EmbeddedDepth([]) == nil)
  }

  @Test func largeMapsAreThinnedOut() throws {
    let map = try map(file(width: 1000, height: 600, DepthHEICWriter.Description()))
    #expect((map.width, map.height) == (333, 200))
    let middle = try #require(map.depth(at: SIMD2(0.5, 0.5)))
    #expect(abs(middle - 255 / (2 * 139)) < 0.02)
  }

  /// The photo must be read as before, without an alpha channel.
  @Test func thePhotoIsUnaffected() throws {
    let bytes = try file(DepthHEICWriter.Description())
    #expect(try ImageHeader(bytes) == ImageHeader(format: .heic, width: 96, height: 64))
    #expect(try ImageCodec.decodeAlpha(bytes) == nil)
    #expect(try ImageCodec.decode(bytes).pixels.allSatisfy { abs(Int($0) - 90) < 6 })
  }

  @Test func damagedFilesGiveAValueOrNil() throws {
    let whole = DamagedInput(try file(DepthHEICWriter.Description()))
    var limits = ImageCodec.Limits()
    limits.maximumPixels = 1 << 16
    var maps = 0
    let copies = Array(whole.truncations(step: 7)) + whole.mutations(1500, seed: 50, header: 1800)
    for copy in copies {
      guard case .metric(let map) = EmbeddedDepth(copy, limits: limits) else { continue }
      #expect(map.depths.count == map.width * map.height)
      maps += 1
    }
    #expect(maps > 0 && maps < copies.count)
  }
}
