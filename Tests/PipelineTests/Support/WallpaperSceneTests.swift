import Foundation
import SceneModel
import TestSupport
import Testing

/// The rendered frames of a video before a wall with a repeated flower.
@Suite struct WallpaperSceneTests {
  private static func tiny(seed: UInt64 = 3, photoCount: Int = 50) -> CaptureScene {
    .wallpaper(seed: seed, width: 80, photoCount: photoCount, fineness: 0.1)
  }

  @Test(arguments: [UInt32(1), 2, 77])
  func theFlowerRepeatsExactly(_ seed: UInt32) {
    var texture = WallpaperTexture(seed: seed)
    texture.unevenness = 0
    let (x, y) = (texture.period.x, texture.period.y)
    func difference(_ shift: SIMD2<Float>) -> Float {
      let differences = (0..<400).map { index in
        // Away from the borders of cells, where rounding decides which cell it is.
        let place = SIMD2(Float(index % 20) + 0.52, Float(index / 20) + 0.52) / 20
        let point = SIMD3(place.x * x, place.y * y, -1)
        let moved = point + SIMD3(shift.x, shift.y, 0)
        let (a, b) = (
          texture.color(at: point, footprint: 0.001), texture.color(at: moved, footprint: 0.001)
        )
        return (a - b).squaredLength.squareRoot()
      }
      return differences.reduce(0, +) / Float(differences.count)
    }
    for period: SIMD2<Float> in [[0, y], [x, y / 2], [2 * x, 0], [-3 * x, 2.5 * y]] {
      #expect(difference(period) < 1e-3)
    }
    for other: SIMD2<Float> in [[x, 0], [0, y / 2], [x / 2, y / 2], [0.3 * x, 0]] {
      #expect(difference(other) > 0.05)
    }
  }

  @Test func thePaperIsUneven() {
    let texture = WallpaperTexture(seed: 1)
    let point = SIMD3<Float>(0.02, 0.03, -1)
    let moved = point + SIMD3(0, texture.period.y, 0)
    let colors = [point, moved].map { texture.color(at: $0, footprint: 0.001) }
    #expect(colors[0] != colors[1])
    #expect((colors[0] - colors[1]).squaredLength.squareRoot() < 0.1)
  }

  @Test func camerasProjectTheObjectIntoItsMask() {
    let capture = Self.tiny()
    for index in [0, 25, 49] { #expect(capture.shareOutsideOfMask(ofPhoto: index) < 0.01) }
  }

  @Test func theObjectIsInsideOfTheFrame() {
    for seed in UInt64(1)...4 { #expect(Self.tiny(seed: seed).smallestMargin > 1.2) }
  }

  @Test func theCameraMovesBySmallStepsOnAnArc() {
    let views = Self.tiny().views
    #expect(Set(views.map(\.roomFromObject)).count == 1)
    let centers = views.map(\.cameraFromRoom.center)
    let steps = zip(centers, centers.dropFirst()).map { ($1 - $0).length }
    #expect(steps.max() ?? 1 < 0.06)
    #expect(steps.min() ?? 0 > 0.005)
    let bearings = centers.map { atan2($0.x, $0.z) * 180 / .pi }
    #expect(abs((bearings.max() ?? 0) - (bearings.min() ?? 0) - 105) < 10)
    // In front of the wall.
    #expect(bearings.allSatisfy { abs($0) < 60 })
  }

  @Test func theNumberOfPhotosIsAParameter() {
    #expect(Self.tiny(photoCount: 7).views.count == 7)
    #expect(Self.tiny(photoCount: 1).views.count == 1)
  }

  @Test func theSeedDeterminesThePhotos() throws {
    func pixels(_ seed: UInt64) throws -> [UInt8] {
      try CaptureScene.wallpaper(seed: seed, width: 60, photoCount: 3, fineness: 0.1)
        .scene(ofPhoto: 2).photo(2).pixels
    }
    #expect(try pixels(1) == pixels(1))
    #expect(try pixels(1) != pixels(2))
  }
}
