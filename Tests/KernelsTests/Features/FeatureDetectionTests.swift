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

  /// Overlapping squares of random size and brightness: rich texture.
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

  /// Offsets to the pixel grid, deviations, and whether the photo is doubled.
  static let blobCases = [
    (SIMD2(70.25, 80.75), 2.0, true), (SIMD2(100.5, 60.5), 3.0, true),
    (SIMD2(120.0, 90.4), 6.0, true), (SIMD2(81.13, 70.9), 1.5, true),
    (SIMD2(70.25, 80.75), 2.6, false), (SIMD2(100.0, 60.4), 4.0, false),
    (SIMD2(120.3, 90.6), 9.0, false),
  ]

  @Test(arguments: blobCases)
  func blobIsDetectedAtItsCenter(center: SIMD2<Double>, deviation: Double, isDoubled: Bool) throws {
    let image = Self.blobs([(center, deviation)])
    var detection = FeatureDetection()
    detection.doublesPhoto = isDoubled
    let set = try detection.features(in: image, KernelControl())
    let errors = set.positions.map { (SIMD2<Double>($0) - center).length }
    let best = try #require(errors.indices.min { errors[$0] < errors[$1] })
    #expect(errors[best] < 0.02)
    // A blob of deviation σ is an extremum of the difference of Gaussians near the scale σ.
    #expect(abs(Double(set.scales[best]) / deviation - 1) < 0.2)
    let pixel = (y: Int(center.y), x: Int(center.x))
    #expect(set.colors[best].x == image.pixels[(pixel.y * image.width + pixel.x) * 3])
  }

  /// The mean error over many offsets reveals a bias that a single offset may hide.
  @Test(arguments: [true, false])
  func positionsAreUnbiased(isDoubled: Bool) throws {
    var detection = FeatureDetection()
    detection.doublesPhoto = isDoubled
    var random = SeededGenerator(seed: 3)
    var spots: [(SIMD2<Double>, Double)] = []
    for row in 0..<5 {
      for column in 0..<7 {
        let x = 30 + 40 * Double(column) + random.uniform()
        let y = 30 + 40 * Double(row) + random.uniform()
        spots.append((SIMD2(x, y), 2.4 + 1.6 * random.uniform()))
      }
    }
    let set = try detection.features(
      in: Self.blobs(spots, width: 300, height: 220), KernelControl())
    var sum = SIMD2<Double>.zero
    for (center, _) in spots {
      let errors = set.positions.map { SIMD2<Double>($0) - center }
      let nearest = try #require(errors.min { $0.length < $1.length })
      #expect(nearest.length < 0.03)
      sum += nearest
    }
    #expect((sum / Double(spots.count)).length < 0.004)
  }

  @Test func orientationFollowsTheGradient() throws {
    // A small spot on a ramp: the ramp's gradient determines the orientation.
    for degrees in stride(from: 5.0, to: 360, by: 31) {
      let angle = degrees * .pi / 180
      let direction = SIMD2(cos(angle), sin(angle))
      var image = RasterImage(width: 80, height: 80, channels: 3)
      for y in 0..<80 {
        for x in 0..<80 {
          let p = SIMD2(Double(x) - 39.5, Double(y) - 39.5)
          let value = 120 + 2 * p.dot(direction) + 6 * exp(-p.squaredLength / 8)
          for c in 0..<3 {
            image.pixels[(y * 80 + x) * 3 + c] = UInt8(min(255, max(0, value.rounded())))
          }
        }
      }
      var detection = FeatureDetection()
      detection.contrastThreshold = 0.005
      let set = try detection.features(in: image, KernelControl())
      let near = set.positions.indices.filter {
        (SIMD2<Double>(set.positions[$0]) - SIMD2(40, 40)).length < 1
      }
      let errors = near.map { abs(remainder(Double(set.orientations[$0]) - angle, 2 * .pi)) }
      #expect(try #require(errors.min()) < 4 * .pi / 180)
    }
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

  @Test func featureLimitKeepsCoverage() throws {
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

  @Test func lowerThresholdDetectsMore() throws {
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

  @Test(arguments: [(0, 0), (1, 1), (7, 40), (8, 8), (64, 64), (9, 700), (900, 8)])
  func plainImagesHaveNoFeatures(width: Int, height: Int) throws {
    let image = RasterImage(width: width, height: height, channels: 3, filledWith: 128)
    for isDoubled in [true, false] {
      var detection = FeatureDetection()
      detection.doublesPhoto = isDoubled
      #expect(try detection.features(in: image, KernelControl()).count == 0)
    }
  }

  @Test(arguments: [(8, 2000), (2500, 9), (17, 16), (33, 31), (60, 1500)])
  func extremeAspectRatiosAreSupported(width: Int, height: Int) throws {
    let image = Self.texture(width: width, height: height)
    for isDoubled in [true, false] {
      var detection = FeatureDetection()
      detection.doublesPhoto = isDoubled
      detection.contrastThreshold = 0.005
      let set = try detection.features(in: image, KernelControl())
      if min(width, height) >= 60 { #expect(set.count > 50) }
      #expect(
        set.positions.allSatisfy {
          (0...Float(width)).contains($0.x) && (0...Float(height)).contains($0.y)
        })
    }
  }

  @Test func grayAndAlphaAreSupported() throws {
    let image = Self.texture(width: 200, height: 160)
    let gray = RasterImage(
      width: 200, height: 160, channels: 1,
      pixels: stride(from: 0, to: image.pixels.count, by: 3).map { image.pixels[$0] })
    let withAlpha = RasterImage(
      width: 200, height: 160, channels: 4,
      pixels: gray.pixels.enumerated().flatMap { [$1, $1, $1, UInt8($0 % 251)] })
    let sets = try [image, gray, withAlpha].map {
      try FeatureDetection().features(in: $0, KernelControl())
    }
    #expect(sets[0].count > 50)
    for set in sets.dropFirst() {
      // The weights of red, green and blue sum to one except for rounding.
      #expect(abs(set.count - sets[0].count) <= 2)
      #expect(set.colors.allSatisfy { $0.x == $0.y && $0.y == $0.z })
    }
  }

  /// The agreement of two feature sets of the same photo: the share of features at the same
  /// position, scale and orientation, and the largest distance of their descriptors.
  static func agreement(_ a: FeatureSet, _ b: FeatureSet) -> (share: Double, worst: Int) {
    var (found, worst, start) = (0, 0, 0)
    for i in 0..<a.count {
      while start < b.count, b.scales[start] > a.scales[i] * 1.001 { start += 1 }
      let partner = (start..<b.count).prefix { b.scales[$0] > a.scales[i] * 0.999 }.first {
        (a.positions[i] - b.positions[$0]).length < 0.01
          && abs(remainder(a.orientations[i] - b.orientations[$0], 2 * .pi)) < 0.01
      }
      guard let partner else { continue }
      found += 1
      for k in 0..<128 {
        let difference = Int(a.descriptors[i * 128 + k]) - Int(b.descriptors[partner * 128 + k])
        worst = max(worst, abs(difference))
      }
    }
    return (Double(found) / Double(max(1, a.count)), worst)
  }

  @Test(arguments: [true, false])
  func allInstructionSetsAgree(isDoubled: Bool) throws {
    let image = Self.texture(width: 333, height: 251)
    var detection = FeatureDetection()
    detection.doublesPhoto = isDoubled
    detection.sufficientFeatures = .max
    detection.instructions = .portable
    let portable = try detection.features(in: image, KernelControl())
    #expect(portable.count > 100)
    var vector: [FeatureSet] = []
    for instructions in [Instructions.avx2, .avx512]
    where instructions.isSupported {
      detection.instructions = instructions
      let set = try detection.features(in: image, KernelControl())
      vector.append(set)
      let agreement = Self.agreement(portable, set)
      #expect(agreement.share > 0.95)
      #expect(agreement.worst <= 8)
      #expect(abs(set.count - portable.count) <= 2)
    }
    for set in vector.dropFirst() {
      #expect(set.descriptors == vector[0].descriptors)
      #expect(set.positions == vector[0].positions)
      #expect(set.orientations == vector[0].orientations)
    }
  }

  @Test func unsupportedInstructionSetsAreRejected() throws {
    var detection = FeatureDetection()
    let image = Self.texture(width: 64, height: 64)
    for instructions in Instructions.allCases where !instructions.isSupported {
      detection.instructions = instructions
      #expect(throws: KernelError.self) {
        _ = try detection.features(in: image, KernelControl())
      }
    }
  }

  @Test func detectionIsDeterministic() throws {
    let image = Self.texture(width: 320, height: 240)
    let sets = try KernelControl(threadCount: 2).parallelMap(4) { _ in
      try FeatureDetection().features(in: image, KernelControl())
    }
    for set in sets.dropFirst() {
      #expect(set.descriptors == sets[0].descriptors)
      #expect(set.positions == sets[0].positions)
      #expect(set.scales == sets[0].scales)
    }
  }

  /// The image rotated by an angle and scaled about its center, and the map of its positions.
  static func warped(
    _ image: RasterImage, degrees: Double, scale: Double
  ) -> (image: RasterImage, map: (SIMD2<Double>) -> SIMD2<Double>) {
    let (c, s) = (cos(degrees * .pi / 180) * scale, sin(degrees * .pi / 180) * scale)
    let center = SIMD2(Double(image.width), Double(image.height)) / 2
    func map(_ p: SIMD2<Double>) -> SIMD2<Double> {
      let d = p - center
      return center + SIMD2(c * d.x - s * d.y, s * d.x + c * d.y)
    }
    var result = RasterImage(width: image.width, height: image.height, channels: 3)
    for y in 0..<image.height {
      for x in 0..<image.width {
        let d = (SIMD2(Double(x) + 0.5, Double(y) + 0.5) - center) / (scale * scale)
        let p = center + SIMD2(c * d.x + s * d.y, -s * d.x + c * d.y) - 0.5
        let cell = p.rounded(.down)
        let f = p - cell
        func value(_ dx: Int, _ dy: Int, _ channel: Int) -> Double {
          let column = min(max(0, Int(cell.x) + dx), image.width - 1)
          let row = min(max(0, Int(cell.y) + dy), image.height - 1)
          return Double(image.pixels[(row * image.width + column) * 3 + channel])
        }
        for channel in 0..<3 {
          let top = value(0, 0, channel) * (1 - f.x) + value(1, 0, channel) * f.x
          let bottom = value(0, 1, channel) * (1 - f.x) + value(1, 1, channel) * f.x
          result.pixels[(y * image.width + x) * 3 + channel] =
            UInt8((top * (1 - f.y) + bottom * f.y).rounded())
        }
      }
    }
    return (result, map)
  }

  /// Features that are detected again in a rotated and scaled copy, and the share of correct
  /// matches.
  @Test(arguments: [(17.0, 1.0), (90.0, 1.0), (133.0, 0.8), (-62.0, 1.4), (200.0, 0.6)])
  func warpedImageMatches(degrees: Double, scale: Double) throws {
    let image = TexturePattern.image(width: 400, height: 320, seed: 5)
    let (copy, map) = Self.warped(image, degrees: degrees, scale: scale)
    let sets = try [image, copy].map { try FeatureDetection().features(in: $0, KernelControl()) }
    let common = (0..<sets[0].count).filter { index in
      let p = map(SIMD2<Double>(sets[0].positions[index]))
      let size = Double(sets[0].scales[index]) * scale
      return size > 1.2 && p.x > 20 && p.y > 20 && p.x < 380 && p.y < 300
    }
    let repeated = common.filter { index in
      let p = map(SIMD2<Double>(sets[0].positions[index]))
      let size = Double(sets[0].scales[index]) * scale
      return sets[1].positions.indices.contains {
        (SIMD2<Double>(sets[1].positions[$0]) - p).length < 0.5 + 0.1 * size
          && abs(log2(Double(sets[1].scales[$0]) / size)) < 0.3
      }
    }
    #expect(common.count > 60)
    #expect(Double(repeated.count) > 0.6 * Double(common.count))
    let matches = try DescriptorMatching().matches(sets[0], sets[1], KernelControl())
    let errors = matches.map { match in
      let p = map(SIMD2<Double>(sets[0].positions[Int(match.first)]))
      return (SIMD2<Double>(sets[1].positions[Int(match.second)]) - p).length
    }
    #expect(Double(matches.count) > 0.5 * Double(common.count))
    #expect(Double(errors.count { $0 < 1.5 }) > 0.97 * Double(errors.count))
    #expect(errors.sorted()[errors.count / 2] < 0.22 * max(1, scale))
  }

  @Test func rotatedPhotoMatchesItself() throws {
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

  @Test func canceledDetectionThrows() throws {
    let flag = CancellationFlag()
    flag.cancel()
    let image = Self.texture(width: 64, height: 64)
    #expect(throws: CancellationError.self) {
      _ = try FeatureDetection().features(in: image, KernelControl(flag: flag))
    }
  }
}
