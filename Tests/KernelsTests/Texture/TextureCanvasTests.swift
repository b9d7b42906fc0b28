import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct TextureCanvasTests {
  private let side = 64
  private let plane = SyntheticMesh.grid(
    cells: 4, origin: [-1, -1, 0], u: [2, 0, 0], v: [0, 2, 0])

  /// The plane fills the texture except for a border of 8 texels; +y is up.
  private func corners() -> [SIMD2<Float>] {
    plane.triangles.flatMap { t in
      [t.a, t.b, t.c].map { index in
        let p = plane.positions[Int(index)]
        return SIMD2<Float>(8 + (p.x + 1) * 24, 8 + (1 - p.y) * 24)
      }
    }
  }

  private func canvas() throws -> TextureCanvas {
    try TextureCanvas(
      RayScene(plane, KernelControl()), corners: corners(), side: side, KernelControl())
  }

  private func source(dense: Mesh) throws -> BakeSource {
    BakeSource(
      maximumDistance: 0.5, cornerNormals: corners().map { _ in [0, 0, 1] },
      cornerTangents: corners().map { _ in [1, 0, 0, 1] },
      dense: try RayScene(dense, KernelControl()), denseNormals: dense.normals)
  }

  private func pixel(_ image: RasterImage, _ x: Int, _ y: Int) -> [UInt8] {
    let start = (y * image.width + x) * image.channels
    return Array(image.pixels[start..<start + image.channels])
  }

  @Test func aSurfaceBakedOntoItselfIsFlat() throws {
    let baked = try canvas().bake(source(dense: plane), displacement: true, KernelControl())
    let flat: [UInt8] = [128, 128, 255]
    #expect((0..<side * side).allSatisfy { pixel(baked.normals, $0 % side, $0 / side) == flat })
    #expect(baked.displacement?.pixels.allSatisfy { abs(Int($0) - 128) <= 1 } == true)
  }

  @Test func slopesAndHeightsAreBaked() throws {
    // Rises by 0.2 to the right and by 0.1 upward in the texture.
    var dense = plane
    dense.positions = plane.positions.map { [$0.x, $0.y, 0.2 * $0.x + 0.1 * $0.y] }
    let normal = SIMD3<Float>(-0.2, -0.1, 1).normalized
    dense.normals = dense.positions.map { _ in normal }
    let baked = try canvas().bake(source(dense: dense), displacement: true, KernelControl())
    let middle = pixel(baked.normals, 32, 32)
    for channel in 0..<3 {
      #expect(abs(Float(middle[channel]) - (127.5 * normal[channel] + 127.5)) <= 1)
    }
    // x = 0.5, y = 0.5 is at height 0.15 of at most 0.5.
    let heights = try #require(baked.displacement)
    #expect(abs(Float(pixel(heights, 44, 20)[0]) - (127.5 + 127.5 * 0.3)) < 3)
  }

  @Test func missingDenseSurfaceGivesAFlatMap() throws {
    var dense = plane
    dense.positions = plane.positions.map { $0 + [0, 0, 3] }
    let baked = try canvas().bake(source(dense: dense), displacement: false, KernelControl())
    #expect(pixel(baked.normals, 32, 32) == [128, 128, 255])
    #expect(baked.displacement == nil)
  }

  @Test func aPlaneIsUnoccluded() throws {
    let open = try canvas().occlusion(
      source(dense: plane), raysPerTexel: 4, maximumDistance: 10, KernelControl())
    #expect(open.pixels.allSatisfy { $0 == 255 })
  }

  @Test func aLongWallOccludesItsFormFactor() throws {
    var dense = plane
    dense.append(SyntheticMesh.grid(cells: 4, origin: [1, -40, 0], u: [0, 0, 1], v: [0, 80, 0]))
    let open = try canvas().occlusion(
      source(dense: dense), raysPerTexel: 8, maximumDistance: 100, KernelControl())
    for x in stride(from: 12, to: 54, by: 3) {
      let distance = 1 - ((Float(x) + 0.5 - 8) / 24 - 1)
      let formFactor = (1 - distance / (1 + distance * distance).squareRoot()) / 2
      for y in [16, 30, 41] {
        #expect(abs(Float(pixel(open, x, y)[0]) / 255 - (1 - formFactor)) < 0.025)
      }
    }
  }

  @Test func weightsOffsetsAndGainsAreApplied() throws {
    let canvas = try canvas()
    #expect(abs(canvas.usage - 48 * 48 / Double(64 * 64)) < 0.02)
    let image = RasterImage(width: 100, height: 100, channels: 3, filledWith: 80)
    let view = PinholeView.fromAbove(image, distance: 4)
    func paints(_ weight: Float, _ offset: Float) -> [FacePaint] {
      let value = SIMD3<Float>(repeating: offset)
      return plane.triangles.indices.map {
        FacePaint(
          face: Int32($0), weights: SIMD3(repeating: weight), offsets: (value, value, value))
      }
    }
    try canvas.paint(paints(0.75, 10), from: view, gain: [1, 0.5, 2], KernelControl())
    try canvas.paint(paints(0.25, 40), from: nil, KernelControl())
    let colors = try canvas.colors(KernelControl())
    // 0.75 · (80 · gain + 10) + 0.25 · 40, also in the space between charts.
    for index in 0..<side * side {
      #expect(pixel(colors, index % side, index / side) == [78, 48, 138])
    }
  }

  @Test func photosArePaintedUpright() throws {
    // Red increases to the right of the photo, green downward.
    var image = RasterImage(width: 120, height: 120, channels: 3)
    for index in 0..<120 * 120 {
      image.pixels[3 * index] = UInt8(2 * (index % 120))
      image.pixels[3 * index + 1] = UInt8(2 * (index / 120))
    }
    let view = PinholeView.fromAbove(image, distance: 4)
    let zero = SIMD3<Float>.zero
    let canvas = try canvas()
    try canvas.paint(
      plane.triangles.indices.map {
        FacePaint(face: Int32($0), weights: .one, offsets: (zero, zero, zero))
      }, from: view, KernelControl())
    let colors = try canvas.colors(KernelControl())
    for (x, y) in [(8, 8), (20, 40), (32, 32), (55, 12), (55, 55)] {
      // Texel to plane to photo: 60 pixels for the plane's side of 2.
      let u = 60 + 30 * ((Float(x) + 0.5 - 8) / 24 - 1)
      let v = 60 + 30 * ((Float(y) + 0.5 - 8) / 24 - 1)
      let value = pixel(colors, x, y)
      #expect(abs(Float(value[0]) - 2 * (u - 0.5)) < 1.5)
      #expect(abs(Float(value[1]) - 2 * (v - 0.5)) < 1.5)
    }
  }
}
