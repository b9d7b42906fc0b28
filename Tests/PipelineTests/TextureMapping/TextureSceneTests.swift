import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// Disturbances in photos must not be visible in the texture: compared with held-out photos, it is
/// nearly as good as from clean photos.
@Suite(.endToEnd) struct TextureSceneTests {
  private static let (width, fineness) = (200, 0.1)
  private static let control = KernelControl(threadCount: 2)
  private static let held = TextureScene.held(width: width, fineness: fineness)
  private static let heldPhotos = Result {
    try [0, 2, 4].map { (index: $0, image: try held.photo($0, control)) }
  }

  /// The model with the exact surface and cameras.
  private func model(of kind: TextureScene) throws -> TexturedMesh {
    let scene = kind.scene(
      width: Self.width, poses: DenseScene.sweep(count: 16), fineness: Self.fineness)
    return try TextureMapping(options: .init(textureSide: 512, maps: [.diffuseColor])).run(
      scene.object, dense: scene.object, reconstruction: scene.reconstruction(),
      images: ImageStore(images: try scene.photos(Self.control)),
      StageContext(control: Self.control))
  }

  /// The peak signal-to-noise ratio in decibels of the colors at the triangles' centers. One gain
  /// per channel and photo is arbitrary.
  private func ratio(of kind: TextureScene) throws -> Double {
    let model = try model(of: kind)
    let photos = try Self.heldPhotos.get()
    let image = try #require(model.atlases[0].maps[.diffuseColor])
    let side = Double(image.width)
    var errors: [Double] = []
    for (index, photo) in photos {
      var pairs: [(x: SIMD3<Double>, y: SIMD3<Double>)] = []
      for (t, uv) in zip(model.mesh.triangles, model.textureTriangles) {
        let p = (t.vertices.reduce(.zero) { $0 + model.mesh.positions[$1] }) / 3
        guard Self.held.isVisible(SIMD3<Double>(p), in: index) else { continue }
        let st = (uv.vertices.reduce(.zero) { $0 + model.textureCoordinates[$1] }) / 3
        let pixel = Self.held.camera.project(Self.held.poses[index] * SIMD3<Double>(p))
        let texel = SIMD2(Double(st.x), 1 - Double(st.y)) * side
        pairs.append((Self.sample(image, texel), Self.sample(photo, pixel)))
      }
      try #require(pairs.count > 500)
      for channel in 0..<3 {
        let xy = pairs.reduce(0) { $0 + $1.x[channel] * $1.y[channel] }
        let gain = xy / pairs.reduce(0) { $0 + $1.x[channel] * $1.x[channel] }
        errors += pairs.map { pow(gain * $0.x[channel] - $0.y[channel], 2) }
      }
    }
    return 10 * log10(255 * 255 / (errors.reduce(0, +) / Double(errors.count)))
  }

  /// The color at a position, bilinear.
  private static func sample(_ image: RasterImage, _ position: SIMD2<Double>) -> SIMD3<Double> {
    let limit = SIMD2(Double(image.width), Double(image.height)) - 1.001
    let p = (position - 0.5).clamped(lowerBound: .zero, upperBound: limit)
    let (x, y) = (Int(p.x), Int(p.y))
    let f = p - p.rounded(.down)
    func pixel(_ x: Int, _ y: Int) -> SIMD3<Double> {
      let start = 3 * (y * image.width + x)
      return SIMD3(
        Double(image.pixels[start]), Double(image.pixels[start + 1]),
        Double(image.pixels[start + 2]))
    }
    let top = pixel(x, y) * (1 - f.x) + pixel(x + 1, y) * f.x
    let bottom = pixel(x, y + 1) * (1 - f.x) + pixel(x + 1, y + 1) * f.x
    return top * (1 - f.y) + bottom * f.y
  }

  @Test func exposureAndOccluderCostLessThanADecibel() throws {
    let clean = try ratio(of: .clean)
    #expect(clean > 24)
    #expect(try ratio(of: .exposure) > clean - 1)
    #expect(try ratio(of: .intruder) > clean - 1)
  }
}
