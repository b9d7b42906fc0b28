import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct FeatureDetectionTests {
  /// Gray Gaussian blobs (position, deviation in pixels) on mid-gray; origin at the corner.
  static func blobs(
    _ blobs: [(SIMD2<Double>, Double)], width: Int = 200, height: Int = 160
  ) -> RasterImage {
    var image = RasterImage(width: width, height: height, channels: 3)
    for y in 0..<height {
      for x in 0..<width {
        let pixel = SIMD2(Double(x) + 0.5, Double(y) + 0.5)
        let value = blobs.reduce(110.0) {
          $0 + 120 * exp(-(pixel - $1.0).squaredLength / (2 * $1.1 * $1.1))
        }
        for c in 0..<3 { image.pixels[(y * width + x) * 3 + c] = UInt8(min(255, value.rounded())) }
      }
    }
    return image
  }

  /// Random checks of several sizes: rich texture.
  static func texture(width: Int, height: Int, seed: UInt64 = 7) -> RasterImage {
    var random = SeededGenerator(seed: seed)
    let spots = (0..<(width * height / 400)).map { _ in
      (
        SIMD2(random.uniform() * Double(width), random.uniform() * Double(height)),
        2 + 4 * random.uniform(), random.uniform() * 160 - 80
      )
    }
    var values = [Double](repeating: 120, count: width * height)
    for (center, radius, contrast) in spots {
      for y in max(0, Int(center.y - radius))..<min(height, Int(center.y + radius) + 1) {
        for x in max(0, Int(center.x - radius))..<min(width, Int(center.x + radius) + 1) {
          values[y * width + x] += contrast
        }
      }
    }
    let pixels = values.flatMap { v in
      [UInt8](repeating: UInt8(min(255, max(0, v))), count: 3)
    }
    return RasterImage(width: width, height: height, channels: 3, pixels: pixels)
  }

  @Test(arguments: [
    (SIMD2(70.25, 80.75), 2.0), (SIMD2(100.5, 60.5), 3.0), (SIMD2(120.0, 90.4), 6.0),
  ])
  func blobIsFoundWhereItIs(center: SIMD2<Double>, deviation: Double) throws {
    let image = Self.blobs([(center, deviation)])
    let set = try FeatureDetection().features(in: image, KernelControl())
    let errors = set.positions.map { (SIMD2<Double>($0) - center).length }
    let best = try #require(errors.indices.min { errors[$0] < errors[$1] })
    #expect(errors[best] < 0.06)
    // A blob of deviation σ is an extremum of the difference of Gaussians near the scale σ.
    #expect(abs(Double(set.scales[best]) / deviation - 1) < 0.2)
    let pixel = (y: Int(center.y), x: Int(center.x))
    #expect(set.colors[best].x == image.pixels[(pixel.y * image.width + pixel.x) * 3])
  }

  @Test func descriptorsAreRootSIFT() throws {
    let image = Self.texture(width: 320, height: 240)
    let set = try FeatureDetection().features(in: image, KernelControl())
    #expect(set.count > 100)
    for index in 0..<set.count {
      let bytes = set.descriptors[index * 128..<(index + 1) * 128]
      let norm = bytes.reduce(0) { $0 + Double($1) * Double($1) }.squareRoot()
      #expect(abs(norm - 512) < 8)
    }
  }

  @Test func largestScaleComesFirst() throws {
    let image = Self.texture(width: 320, height: 240)
    let set = try FeatureDetection().features(in: image, KernelControl())
    #expect(zip(set.scales, set.scales.dropFirst()).allSatisfy { $0 >= $1 })
    #expect(set.positions.allSatisfy { (0...320).contains($0.x) && (0...240).contains($0.y) })
    #expect(set.orientations.allSatisfy { (0...Float.pi * 2 + 1e-5).contains($0) })
  }

  @Test func limitKeepsFeaturesEverywhere() throws {
    let image = Self.texture(width: 480, height: 360)
    var detection = FeatureDetection()
    detection.gridCells = 4
    detection.maximumFeatures = 120
    let set = try detection.features(in: image, KernelControl())
    #expect(set.count == 120)
    var cells = [Int](repeating: 0, count: 12)
    for p in set.positions { cells[min(2, Int(p.y / 120)) * 4 + min(3, Int(p.x / 120))] += 1 }
    #expect(cells.allSatisfy { (5...15).contains($0) })
  }

  @Test func lowerThresholdFindsMore() throws {
    let image = Self.texture(width: 320, height: 240)
    var detection = FeatureDetection()
    detection.sufficientFeatures = 0
    let few = try detection.features(in: image, KernelControl()).count
    detection.sufficientFeatures = .max
    let many = try detection.features(in: image, KernelControl()).count
    detection.contrastThreshold /= 4
    #expect(few <= many)
    #expect(try detection.features(in: image, KernelControl()).count > many)
  }

  @Test(arguments: [(0, 0), (1, 1), (7, 40), (64, 64)])
  func plainImagesHaveNoFeatures(width: Int, height: Int) throws {
    let image = RasterImage(width: width, height: height, channels: 3, filledWith: 128)
    #expect(try FeatureDetection().features(in: image, KernelControl()).count == 0)
  }

  @Test func turnedPhotoMatchesItself() throws {
    let image = Self.texture(width: 320, height: 240)
    var turned = RasterImage(width: 240, height: 320, channels: 3)
    for y in 0..<240 {
      for x in 0..<320 {
        for c in 0..<3 {
          turned.pixels[(x * 240 + 239 - y) * 3 + c] = image.pixels[(y * 320 + x) * 3 + c]
        }
      }
    }
    let sets = try [image, turned].map { try FeatureDetection().features(in: $0, KernelControl()) }
    let matches = try DescriptorMatching().matches(sets[0], sets[1], KernelControl())
    #expect(matches.count > sets[0].count / 2)
    let errors = matches.map { match -> Float in
      let p = sets[0].positions[Int(match.first)]
      return (sets[1].positions[Int(match.second)] - SIMD2(240 - p.y, p.x)).length
    }
    #expect(errors.sorted()[errors.count / 2] < 0.05)
  }

  @Test func cancelledDetectionThrows() throws {
    let flag = CancellationFlag()
    flag.cancel()
    let image = Self.texture(width: 64, height: 64)
    #expect(throws: CancellationError.self) {
      _ = try FeatureDetection().features(in: image, KernelControl(flag: flag))
    }
  }
}
