import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

/// Images of one smooth texture under known transformations.
@Suite struct TemplateMatchingTests {
  private let center = SIMD2(60.3, 55.7)

  /// Renders texture(inverse · (pixel − shift)), with gain and offset applied to the brightness.
  private func picture(
    shift: SIMD2<Double> = .zero, inverse: SIMD4<Double> = [1, 0, 0, 1], gain: Double = 1,
    offset: Double = 0
  ) -> RasterImage {
    var image = RasterImage(width: 130, height: 120, channels: 1)
    for y in 0..<image.height {
      for x in 0..<image.width {
        let p = SIMD2(Double(x) + 0.5, Double(y) + 0.5) - shift
        let q = SIMD2(inverse.x * p.x + inverse.y * p.y, inverse.z * p.x + inverse.w * p.y)
        let value =
          110 + 35 * sin(0.31 * q.x + 0.22 * q.y) + 30 * cos(0.27 * q.y - 0.4 * q.x)
          + 20 * sin(0.5 * q.y)
        image.pixels[y * image.width + x] = UInt8(
          min(255, max(0, (gain * value + offset).rounded())))
      }
    }
    return image
  }

  private func templates(step: Double = 1) throws -> TemplateMatching.Templates {
    try TemplateMatching.templates(of: [.init(center: center, step: step)], in: picture())
  }

  @Test(arguments: [1.0, 1.5, 2, 3]) func shiftIsRecovered(step: Double) throws {
    let templates = try templates(step: step)
    #expect(templates.isValid == [true])
    for shift in [SIMD2(0.37, -0.81), SIMD2(1.6, 1.2), SIMD2(-0.05, 0.5)] {
      let found = try TemplateMatching().matches(
        [.init(template: 0, step: step, warp: [1, 0, 0, 1], expected: center)], of: templates,
        in: picture(shift: shift))
      let match = try #require(found[0])
      #expect((match.center - center - shift).length < 0.03 * step)
      #expect(match.zncc > 0.995)
    }
  }

  @Test func warpAndBrightnessAreCompensated() throws {
    // The other photo is rotated by 20° and magnified by 1.3.
    let (c, s) = (1.3 * cos(0.35), 1.3 * sin(0.35))
    let inverse = SIMD4(c, s, -s, c) / (1.3 * 1.3)
    let shift = SIMD2(30.0, -10.0)
    let expected = SIMD2(c * center.x - s * center.y, s * center.x + c * center.y) + shift
    let found = try TemplateMatching().matches(
      [.init(template: 0, step: 1, warp: [c, -s, s, c], expected: expected + [0.8, -0.6])],
      of: templates(), in: picture(shift: shift, inverse: inverse, gain: 0.7, offset: 40))
    let match = try #require(found[0])
    #expect((match.center - expected).length < 0.03)
  }

  /// On noise, at places up to the border of the photo.
  @Test(arguments: [1, 2, 3] as [UInt64])
  func allInstructionSetsGiveTheSameResult(seed: UInt64) throws {
    var random = SplitMix64(seed: seed)
    var image = RasterImage(width: 90, height: 70, channels: 1)
    for pixel in image.pixels.indices { image.pixels[pixel] = .random(in: 0...255, using: &random) }
    func number(_ range: ClosedRange<Double>) -> Double { .random(in: range, using: &random) }
    let locations = (0..<200).map { _ in
      TemplateMatching.Location(center: [number(0...90), number(0...70)], step: number(1...5))
    }
    let searches = (0..<200).map { template in
      TemplateMatching.Search(
        template: template, step: locations[template].step,
        warp: [number(0.8...1.2), number(-0.3...0.3), number(-0.3...0.3), number(0.8...1.2)],
        expected: locations[template].center + [number(-1...1), number(-1...1)])
    }
    var matching = TemplateMatching()
    matching.instructions = .portable
    let templates = try TemplateMatching.templates(
      of: locations, in: image, instructions: .portable)
    let matches = try matching.matches(searches, of: templates, in: image)
    #expect(matches.count { $0 != nil } > 10)
    for instructions in [Instructions.avx2, .avx512] where instructions.isSupported {
      let others = try TemplateMatching.templates(
        of: locations, in: image, instructions: instructions)
      #expect(others.samples == templates.samples && others.isValid == templates.isValid)
      matching.instructions = instructions
      #expect(try matching.matches(searches, of: others, in: image) == matches)
    }
  }

  @Test func unlocatableTemplatesAreInvalid() throws {
    let flat = RasterImage(width: 40, height: 40, channels: 1, filledWith: 90)
    var stripes = flat
    for index in stripes.pixels.indices {
      stripes.pixels[index] = index % 40 / 4 % 2 == 0 ? 60 : 160
    }
    let place = TemplateMatching.Location(center: [20, 20], step: 1)
    #expect(try TemplateMatching.templates(of: [place], in: flat).isValid == [false])
    #expect(try TemplateMatching.templates(of: [place], in: stripes).isValid == [false])
    let corner = TemplateMatching.Location(center: [3, 3], step: 1)
    #expect(try TemplateMatching.templates(of: [corner], in: picture()).isValid == [false])
  }

  @Test func searchesLeavingTheirAreaFail() throws {
    let templates = try templates()
    func match(_ expected: SIMD2<Double>, _ image: RasterImage) throws -> TemplateMatching.Match? {
      try TemplateMatching().matches(
        [.init(template: 0, step: 1, warp: [1, 0, 0, 1], expected: expected)], of: templates,
        in: image)[0]
    }
    #expect(try match([2, 2], picture()) == nil)
    #expect(try match(center, picture(shift: [4.5, 0])) == nil)
    let degenerate = try TemplateMatching().matches(
      [.init(template: 0, step: 1, warp: [1, 1, 1, 1], expected: center)], of: templates,
      in: picture())
    #expect(degenerate == [nil])
    #expect(throws: KernelError.self) {
      try TemplateMatching().matches(
        [.init(template: 5, step: 1, warp: [1, 0, 0, 1], expected: center)], of: templates,
        in: picture())
    }
  }

  /// The texture varies little along y, as the grain of wood does: the position is uncertain there.
  @Test func covarianceIsThatOfRepeatedMeasurements() throws {
    var random = SeededGenerator(seed: 9)
    func picture(noise: Double) -> RasterImage {
      var image = RasterImage(width: 80, height: 80, channels: 1)
      for y in 0..<image.height {
        for x in 0..<image.width {
          let value = 120 + 55 * sin(0.6 * Double(x)) + 20 * sin(0.35 * Double(y) + 0.4)
          image.pixels[y * image.width + x] = UInt8(
            min(255, max(0, (value + noise * random.normal3().x).rounded())))
        }
      }
      return image
    }
    let center = SIMD2(40.0, 38.0)
    let templates = try TemplateMatching.templates(
      of: [.init(center: center, step: 1)], in: picture(noise: 0))
    let search = TemplateMatching.Search(
      template: 0, step: 1, warp: [1, 0, 0, 1], expected: center)
    var (measured, predicted) = (SIMD3<Double>.zero, SIMD3<Double>.zero)
    let count = 300.0
    for _ in 0..<Int(count) {
      let match = try #require(
        TemplateMatching().matches([search], of: templates, in: picture(noise: 4))[0])
      let error = match.center - center
      measured += SIMD3(error.x * error.x, error.x * error.y, error.y * error.y) / count
      predicted += match.covariance / count
    }
    #expect(predicted.z > 10 * predicted.x)
    // Rounding to gray levels and interpolation between pixels are not part of the prediction.
    for axis in [0, 2] { #expect(abs(log2(measured[axis] / predicted[axis])) < 1) }
    #expect(abs(predicted.y) < 0.1 * (predicted.x * predicted.z).squareRoot())
  }
}
