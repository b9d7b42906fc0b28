import Kernels
import SceneModel
import Testing

@Suite struct DiscDrawingTests {
  /// A point at depth 5 is drawn at 10 pixels per unit.
  private let camera = Camera(width: 40, height: 30, focalLength: [50, 50])

  private func drawn(
    _ discs: [(SIMD3<Float>, radius: Float, label: UInt8)], _ camera: Camera? = nil
  ) throws -> RasterImage {
    try Discs(
      positions: discs.map { $0.0 }, radii: discs.map { $0.radius },
      labels: discs.map { $0.label }
    ).drawn(by: camera ?? self.camera, at: .identity, KernelControl())
  }

  /// The expected image of one disc, in pixels.
  private func disc(x: Double, y: Double, radius: Double, label: UInt8) -> [UInt8] {
    (0..<40 * 30).map { pixel in
      let (dx, dy) = (Double(pixel % 40) + 0.5 - x, Double(pixel / 40) + 0.5 - y)
      return dx * dx + dy * dy <= radius * radius ? label : 0
    }
  }

  @Test func discsAreRoundAndHaveTheirSize() throws {
    let image = try drawn([([0, 0, 5], radius: 0.5, label: 7)])
    #expect(image.width == 40 && image.height == 30 && image.channels == 1)
    #expect(image.pixels == disc(x: 20, y: 15, radius: 5, label: 7))
    // Partly outside of the photo.
    #expect(
      try drawn([([-2, 1, 5], radius: 0.75, label: 1)]).pixels
        == disc(x: 0, y: 25, radius: 7.5, label: 1))
  }

  @Test func smallDiscsCoverAPixel() throws {
    let centered = Camera(
      width: 40, height: 30, focalLength: [50, 50], principalPoint: [20.5, 15.5])
    let image = try drawn([([0, 0, 5], radius: 1e-6, label: 3)], centered)
    #expect(image.pixels.indices.filter { image.pixels[$0] != 0 } == [15 * 40 + 20])
    // On the corner of four pixels.
    #expect(try drawn([([0, 0, 5], radius: 0, label: 3)]).pixels.contains(3))
  }

  @Test func theNearestDiscIsVisible() throws {
    let near = (SIMD3<Float>(0, 0, 4), radius: Float(0.2), label: UInt8(1))
    let far = (SIMD3<Float>(0, 0, 5), radius: Float(1), label: UInt8(2))
    let expected = zip(
      disc(x: 20, y: 15, radius: 2.5, label: 1), disc(x: 20, y: 15, radius: 10, label: 2)
    ).map { $0 != 0 ? $0 : $1 }
    #expect(try drawn([near, far]).pixels == expected)
    #expect(try drawn([far, near]).pixels == expected)
  }

  @Test func invisiblePointsAreIgnored() throws {
    let image = try drawn([
      ([0, 0, -5], radius: 0.5, label: 1), ([0, 0, 0], radius: 0.5, label: 1),
      ([.nan, 0, 5], radius: 0.5, label: 1), ([0, .infinity, 5], radius: 0.5, label: 1),
      ([0, 0, .nan], radius: 0.5, label: 1), ([50, 0, 5], radius: 0.5, label: 1),
      // Larger than the photo: next to the camera.
      ([0, 0, 5], radius: 4, label: 1),
    ])
    #expect(image.pixels.allSatisfy { $0 == 0 })
    #expect(try drawn([]).pixels == [UInt8](repeating: 0, count: 40 * 30))
  }

  @Test func theCameraMayMove() throws {
    let moved = try Discs(positions: [[1, 0, 0]], radii: [0.5], labels: [4]).drawn(
      by: camera, at: RigidTransform(rotation: .identity, translation: [-1, 0, 5]),
      KernelControl())
    #expect(moved.pixels == disc(x: 20, y: 15, radius: 5, label: 4))
  }

  @Test func wrongCountsAreAnError() {
    let discs = [
      Discs(positions: [[0, 0, 5]], radii: [], labels: [1]),
      Discs(positions: [[0, 0, 5]], radii: [1], labels: [1, 2]),
      Discs(positions: [], radii: [1], labels: [1]),
    ]
    for discs in discs {
      #expect(throws: KernelError.self) {
        try discs.drawn(by: camera, at: .identity, KernelControl())
      }
    }
  }

  @Test func canceledDrawingThrows() {
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      try Discs(positions: [[0, 0, 5]], radii: [1], labels: [1])
        .drawn(by: camera, at: .identity, KernelControl(flag: flag))
    }
  }
}
