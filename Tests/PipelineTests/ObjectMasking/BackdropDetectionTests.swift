import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct BackdropDetectionTests {
  private let width = 120
  private let height = 90
  private let columns = 30..<80
  private let rows = 20..<60

  private func isObject(_ x: Int, _ y: Int) -> Bool { columns.contains(x) && rows.contains(y) }

  /// A textured object in front of a backdrop; `hole` selects pixels of it that have the color of
  /// the backdrop, too.
  private func photo(
    seed: UInt32 = 1, hole: (_ x: Int, _ y: Int) -> Bool = { _, _ in false }
  ) -> RasterImage {
    var image = textured(seed: seed)
    for pixel in 0..<width * height {
      let (x, y) = (pixel % width, pixel / width)
      guard !isObject(x, y) || hole(x, y) else { continue }
      image.pixels.replaceSubrange(3 * pixel..<3 * pixel + 3, with: [240, 241, 238])
    }
    return image
  }

  private func textured(seed: UInt32) -> RasterImage {
    TexturePattern.image(width: width, height: height, seed: seed)
  }

  /// All pixels except the object and the pixels that touch it.
  private var surroundings: [UInt8] {
    (0..<width * height).map { pixel in
      let (x, y) = (pixel % width, pixel / width)
      let isNear = (29...80).contains(x) && (19...60).contains(y)
      return isNear ? 0 : 255
    }
  }

  @Test func theBackdropIsWhatSurroundsTheObject() throws {
    let photos = (UInt32(1)...3).map { photo(seed: $0) }
    let backdrop = try #require(
      try BackdropDetection().run(photos, KernelControl(threadCount: 2)))
    #expect(backdrop.masks.count == 3)
    #expect(backdrop.color == [240, 241, 238])
    for mask in backdrop.masks {
      #expect(mask.width == width && mask.height == height && mask.channels == 1)
      #expect(mask.pixels == surroundings)
    }
  }

  @Test func enclosedRegionsAreNotBackdrop() throws {
    let photos = [photo { x, y in (45..<65).contains(x) && (30..<50).contains(y) }]
    let backdrop = try #require(try BackdropDetection().run(photos, KernelControl()))
    #expect(backdrop.masks.map(\.pixels) == [surroundings])
  }

  @Test func texturedSurroundingsAreNone() throws {
    let photos = (UInt32(1)...3).map { textured(seed: $0) }
    #expect(try BackdropDetection().run(photos, KernelControl()) == nil)
    #expect(try BackdropDetection().run([], KernelControl()) == nil)
  }

  @Test func mostPhotosMustShowABackdrop() throws {
    let (with, without) = (photo(), textured(seed: 9))
    let few = [with, without, with, without, with]
    #expect(try BackdropDetection().run(few, KernelControl()) == nil)
    let most = [with, without, with, with, with]
    let backdrop = try #require(try BackdropDetection().run(most, KernelControl()))
    #expect(backdrop.masks.map { $0.pixels.contains(255) } == [true, false, true, true, true])
    #expect(backdrop.masks[1].pixels.count == width * height)
  }
}
