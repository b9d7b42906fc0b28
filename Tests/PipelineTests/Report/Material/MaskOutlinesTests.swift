import SceneModel
import Testing

@testable import Pipeline

@Suite struct MaskOutlinesTests {
  private func mask(_ rows: [String]) -> RasterImage {
    RasterImage(
      width: rows[0].count, height: rows.count, channels: 1,
      pixels: rows.joined().map { $0 == "#" ? 255 : 0 })
  }

  /// Twice the signed area of a polygon.
  private func area(_ polygon: [SIMD2<Int>]) -> Int {
    polygon.indices.reduce(0) { sum, index in
      let (a, b) = (polygon[index], polygon[(index + 1) % polygon.count])
      return sum + a.x * b.y - a.y * b.x
    }
  }

  @Test func aRectangleHasFourCorners() {
    let outlines = MaskOutlines(mask(["....", ".##.", ".##.", "...."]))
    #expect(outlines.polygons.count == 1)
    #expect(Set(outlines.polygons[0]) == [[1, 1], [3, 1], [3, 3], [1, 3]])
  }

  @Test func holesAreOutlinedTheOtherWay() {
    let outlines = MaskOutlines(mask(["#####", "#...#", "#...#", "#####"]))
    #expect(outlines.polygons.map(area).sorted() == [-12, 40])
  }

  @Test func pixelsThatTouchAtACornerStayApart() {
    let outlines = MaskOutlines(mask(["#.", ".#"]))
    #expect(outlines.polygons.map(area) == [2, 2])
    #expect(outlines.polygons.allSatisfy { $0.count == 4 })
  }

  @Test(arguments: 1...20)
  func areasAddUpToThePixels(seed: UInt64) {
    var generator = SplitMix64(seed: seed)
    let pixels = (0..<30 * 20).map { _ in generator.next() % 3 == 0 ? UInt8(0) : 200 }
    let outlines = MaskOutlines(RasterImage(width: 30, height: 20, channels: 1, pixels: pixels))
    #expect(outlines.polygons.map(area).reduce(0, +) == 2 * pixels.count { $0 > 0 })
  }

  @Test func stepsBecomeStraight() throws {
    let rows = (0..<8).map { y in String((0..<8).map { $0 <= y ? "#" : "." }) }
    let outline = try #require(MaskOutlines(mask(rows)).smoothed.first)
    // Along the stairs, x − y is 1/2 at the middle of each side.
    let steps = outline.filter { $0.x > 1.5 && $0.y < 6.5 && $0.x - $0.y > -0.5 }
    #expect(steps.count >= 8)
    #expect(steps.allSatisfy { abs(abs($0.x - $0.y - 0.5) - 0.0) <= 0.5 + 1e-9 })
  }

  @Test func emptyMasksHaveNone() {
    #expect(MaskOutlines(mask(["..", ".."])).polygons.isEmpty)
  }
}
