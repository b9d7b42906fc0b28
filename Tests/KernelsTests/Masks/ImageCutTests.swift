import Kernels
import SceneModel
import Testing

@Suite struct ImageCutTests {
  private let width = 40
  private let height = 30

  private var uniform: RasterImage {
    RasterImage(width: width, height: height, channels: 3, filledWith: 90)
  }

  private func odds(_ value: (_ x: Int, _ y: Int) -> Float) -> [Float] {
    (0..<width * height).map { value($0 % width, $0 / width) }
  }

  private func marked(_ mask: RasterImage) -> [Bool] { mask.pixels.map { $0 == 255 } }

  @Test func withoutSmoothnessTheSignDecides() throws {
    var cut = ImageCut()
    cut.smoothness = 0
    let odds = odds { x, y in (x * 7 + y * 13) % 5 < 2 ? 0.01 + Float(x) : -0.01 - Float(y) }
    let mask = try cut.mask(of: uniform, logOdds: odds, KernelControl())
    #expect(mask.width == width && mask.height == height && mask.channels == 1)
    let expected: [UInt8] = odds.map { $0 > 0 ? 255 : 0 }
    #expect(mask.pixels == expected)
  }

  @Test func isolatedErrorsAreCorrected() throws {
    let (left, right) = (12 * width + 9, 20 * width + 31)
    var odds = odds { x, _ in x < 20 ? 3 : -3 }
    odds[left] = -3
    odds[right] = 3
    var image = uniform
    // The surroundings have another color.
    for pixel in 0..<width * height where pixel % width >= 20 { image.pixels[3 * pixel] = 200 }
    let mask = try ImageCut().mask(of: image, logOdds: odds, KernelControl())
    #expect(marked(mask) == (0..<width * height).map { $0 % width < 20 })
  }

  @Test func cutsFollowEdges() throws {
    var image = uniform
    func isObject(_ x: Int, _ y: Int) -> Bool { 2 * x + y < 50 }
    for pixel in 0..<width * height where isObject(pixel % width, pixel / width) {
      image.pixels.replaceSubrange(3 * pixel..<3 * pixel + 3, with: [240, 250, 230])
    }
    // Nothing is known but two small areas far from the edge.
    let odds = odds { x, y in
      guard (10..<16).contains(y) else { return 0 }
      return (3..<6).contains(x) ? 25 : (33..<36).contains(x) ? -25 : 0
    }
    let mask = try ImageCut().mask(of: image, logOdds: odds, KernelControl())
    #expect(marked(mask) == (0..<width * height).map { isObject($0 % width, $0 / width) })
  }

  @Test func certainPixelsKeepTheirSign() throws {
    let index = 15 * width + 20
    var odds = [Float](repeating: -3, count: width * height)
    odds[index] = 25
    let mask = try ImageCut().mask(of: uniform, logOdds: odds, KernelControl())
    #expect(mask.pixels.indices.filter { mask.pixels[$0] != 0 } == [index])
    var cut = ImageCut()
    cut.certainty = 30
    let smoothed = try cut.mask(of: uniform, logOdds: odds, KernelControl())
    #expect(smoothed.pixels.allSatisfy { $0 == 0 })
  }

  @Test func allPixelsMayBeCertain() throws {
    let odds = odds { x, y in (x + y).isMultiple(of: 2) ? 20 : -20 }
    let mask = try ImageCut().mask(of: uniform, logOdds: odds, KernelControl())
    #expect(marked(mask) == odds.map { $0 > 0 })
    let pixel = RasterImage(width: 1, height: 1, channels: 3)
    for value: Float in [25, 1, -1] {
      let mask = try ImageCut().mask(of: pixel, logOdds: [value], KernelControl())
      let expected: UInt8 = value > 0 ? 255 : 0
      #expect(mask.pixels == [expected])
    }
  }

  @Test func invalidInputIsAnError() {
    let gray = RasterImage(width: width, height: height, channels: 1)
    let odds = [Float](repeating: 1, count: width * height)
    #expect(throws: KernelError.self) {
      try ImageCut().mask(of: uniform, logOdds: Array(odds.dropLast()), KernelControl())
    }
    #expect(throws: KernelError.self) {
      try ImageCut().mask(of: gray, logOdds: odds, KernelControl())
    }
    var cut = ImageCut()
    cut.smoothness = -1
    #expect(throws: KernelError.self) {
      try cut.mask(of: uniform, logOdds: odds, KernelControl())
    }
  }

  @Test func canceledCutThrows() {
    let flag = CancellationFlag()
    flag.cancel()
    let odds = [Float](repeating: 1, count: width * height)
    #expect(throws: CancellationError.self) {
      try ImageCut().mask(of: uniform, logOdds: odds, KernelControl(flag: flag))
    }
  }
}
