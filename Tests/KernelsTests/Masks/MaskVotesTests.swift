import Kernels
import SceneModel
import Testing

@Suite struct MaskVotesTests {
  private let camera = Camera(width: 10, height: 8, focalLength: [10, 10])

  /// The point at depth 2 that the camera shows at the center of a pixel.
  private func point(_ x: Float, _ y: Float) -> SIMD3<Float> {
    [(x + 0.5 - 5) / 5, (y + 0.5 - 4) / 5, 2]
  }

  /// A mask that marks the columns from `column` on.
  private func mask(from column: Int, value: UInt8 = 255) -> RasterImage {
    var mask = RasterImage(width: 10, height: 8, channels: 1)
    for pixel in mask.pixels.indices where pixel % 10 >= column { mask.pixels[pixel] = value }
    return mask
  }

  @Test func votesAreCounted() throws {
    var votes = MaskVotes([
      point(0, 0), point(4, 3), point(5, 3), point(9, 7),
      // Outside of the photo, behind the camera, and no point.
      point(10, 3), point(-1, 3), point(5, 8), [0, 0, -2], [0, .nan, 2],
    ])
    #expect(votes.seen.allSatisfy { $0 == 0 } && votes.inside.allSatisfy { $0 == 0 })
    try votes.add(mask(from: 5), of: camera, at: .identity)
    #expect(votes.seen == [1, 1, 1, 1, 0, 0, 0, 0, 0])
    #expect(votes.inside == [0, 0, 1, 1, 0, 0, 0, 0, 0])
    try votes.add(mask(from: 4, value: 128), of: camera, at: .identity)
    try votes.add(mask(from: 0, value: 127), of: camera, at: .identity)
    #expect(votes.seen == [3, 3, 3, 3, 0, 0, 0, 0, 0])
    #expect(votes.inside == [0, 1, 2, 2, 0, 0, 0, 0, 0])
  }

  @Test func votesOfSeveralPartsAreAdded() throws {
    let points = [point(1, 1), point(8, 1)]
    var (first, second) = (MaskVotes(points), MaskVotes(points))
    try first.add(mask(from: 5), of: camera, at: .identity)
    try second.add(mask(from: 0), of: camera, at: .identity)
    first.add(second)
    #expect(first.seen == [2, 2] && first.inside == [1, 2])
  }

  @Test func thePoseIsApplied() throws {
    var votes = MaskVotes([point(4, 3) - [1, 0, 0]])
    try votes.add(
      mask(from: 4), of: camera,
      at: RigidTransform(rotation: .identity, translation: [1, 0, 0]))
    #expect(votes.seen == [1] && votes.inside == [1])
  }

  @Test func unsuitableMasksAreAnError() {
    let unsuitable = [
      RasterImage(width: 8, height: 10, channels: 1),
      RasterImage(width: 10, height: 8, channels: 3),
    ]
    for image in unsuitable {
      var votes = MaskVotes([point(1, 1)])
      #expect(throws: KernelError.self) { try votes.add(image, of: camera, at: .identity) }
    }
  }
}
