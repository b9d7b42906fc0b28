import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct SkyDetectionTests {
  private static let (width, height, horizon) = (400, 300, 120)

  /// A photo of a textured facade below a plain area of one color, taken by a camera that is level
  /// or, with `quarterTurns`, rotated about its axis.
  private func sky(
    color: SIMD3<UInt8> = [120, 170, 230], quarterTurns: Int = 0, observations: Int = 0,
    worldUp: WorldFrame.Up = .cameras
  ) throws -> RasterImage? {
    var image = TexturePattern.image(width: Self.width, height: Self.height, seed: 5)
    for y in 0..<Self.horizon {
      for x in 0..<Self.width {
        for channel in 0..<3 { image.pixels[3 * (y * Self.width + x) + channel] = color[channel] }
      }
    }
    let camera = Camera(
      width: Self.width, height: Self.height, focalLength: [400, 400],
      principalPoint: [200, Double(Self.horizon)])
    let roll = Quaternion(angle: Double(quarterTurns) * .pi / 2, axis: [0, 0, 1])
    // Camera axes are x right, y down, z forward.
    let level = Quaternion(angle: .pi, axis: [1, 0, 0])
    var photo = SyntheticScene().photos[0]
    (photo.width, photo.height) = (Self.width, Self.height)
    var random = SeededGenerator(seed: 2)
    func pixel(_ rows: Range<Int>) -> SIMD2<Double> {
      [
        Double(Self.width) * random.uniform(),
        Double(rows.lowerBound) + Double(rows.count) * random.uniform(),
      ]
    }
    let pixels =
      (0..<500).map { _ in pixel(Self.horizon..<Self.height) }
      + (0..<observations).map { _ in pixel(0..<Self.horizon) }
    let points = pixels.map {
      ScenePoint(position: .zero, track: [Observation(photo: ID(0), feature: 0, pixel: $0)])
    }
    let reconstruction = Reconstruction(
      cameras: [camera], photos: [photo],
      poses: [RigidTransform(rotation: roll * level, translation: .zero)], points: points,
      worldFrame: WorldFrame(up: worldUp))
    let result = try SkyDetection().run(
      reconstruction, images: ImageStore(images: [image]), StageContext())
    return result?.masks[0]
  }

  /// The share of the plain area and of the facade that a mask leaves out.
  private func excluded(_ mask: RasterImage) -> (plain: Double, facade: Double) {
    func share(_ rows: Range<Int>) -> Double {
      let pixels = rows.flatMap { y in (0..<mask.width).map { y * mask.width + $0 } }
      return Double(pixels.count { mask.pixels[$0] == 0 }) / Double(pixels.count)
    }
    return (share(0..<Self.horizon), share(Self.horizon..<Self.height))
  }

  @Test(arguments: [[120, 170, 230], [250, 250, 250]] as [SIMD3<UInt8>])
  func blueAndBrightAreasAboveTheHorizonAreSky(color: SIMD3<UInt8>) throws {
    let mask = try #require(try sky(color: color))
    let share = excluded(mask)
    #expect(share.plain > 0.99 && share.facade < 0.01)
  }

  @Test func darkAreasAreNoSky() throws {
    #expect(try sky(color: [20, 20, 20]) == nil)
  }

  /// A wall has points.
  @Test func areasWithPointsAreNoSky() throws {
    #expect(try sky(observations: 100) == nil)
  }

  /// A bright floor.
  @Test func areasBelowTheHorizonAreNoSky() throws {
    #expect(try sky(quarterTurns: 2) == nil)
  }

  @Test func withoutAnUpDirectionThereIsNoSky() throws {
    #expect(try sky(worldUp: .unknown) == nil)
  }
}
