import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// Cloud, surface and texture from photos with masks. The masks exclude the lower part of a statue,
/// which nothing else separates from the upper part.
@Suite(.serialized) struct MaskedModelTests {
  private static let limit: Float = 0.1

  private struct Masked {
    var scene: RenderedScene
    var photos: [RasterImage]
    var masks: [RasterImage?]

    init() throws {
      scene = RenderedScene.statue(photoCount: 8, upperCount: 3, width: 240, height: 180)
      scene.samplesPerSide = 1
      photos = try scene.photos(KernelControl(threadCount: 2))
      masks = scene.poses.indices.map { [scene] index in
        scene.mask(index) { $0.y > MaskedModelTests.limit }
      }
      // One photo has no mask, and one mask is damaged.
      masks[3] = nil
      masks[7]?.pixels = [UInt8](repeating: 255, count: 240 * 180)
    }

    func cloud(threads: Int = 2, notes: StageNotes = StageNotes()) throws -> PointCloud {
      try PointCloudGeneration(options: .init(maximumPixelsPerView: 240 * 180)).run(
        scene.reconstruction(), images: ImageStore(images: photos, masks: masks),
        StageContext(control: KernelControl(threadCount: threads), notes: notes))
    }
  }

  @Test(.endToEnd) func modelMatchesTheMasksAtAnyThreadCount() throws {
    let masked = try Masked()
    let (scene, limit) = (masked.scene, Self.limit)
    let notes = StageNotes()
    let cloud = try masked.cloud(threads: 1, notes: notes)
    let again = try masked.cloud(threads: 2)
    #expect(cloud.positions == again.positions && cloud.photoIndices == again.photoIndices)
    let outside = try #require(notes.counts["pointsOutsideMasks"])
    #expect(outside == 0)
    #expect(cloud.count > 1500)
    // A pixel is 2.2 mm wide, and the masks are one pixel too wide.
    #expect(cloud.positions.allSatisfy { $0.y > limit - 0.008 })

    let reconstruction = scene.reconstruction()
    let images = ImageStore(images: masked.photos, masks: masked.masks)
    let silhouettes = try #require(try Silhouettes(reconstruction, images: images))
    #expect(try silhouettes.isInside([0, 0.2, 0]) && !silhouettes.isInside([0, 0.05, 0]))
    #expect(try !silhouettes.isInside([0.25, 0.2, 0]))
    var options = MeshGeneration.Options()
    options.maximumDepth = 7
    let mesh = try MeshGeneration(options)
      .run(cloud, reconstruction, silhouettes: silhouettes, StageContext())
    let bounds = try #require(mesh.bounds)
    #expect(bounds.min.y > limit - 0.015 && bounds.min.y < limit + 0.01)
    #expect(bounds.max.y > 0.24)

    // Only areas outside the masks have this color.
    var photos = masked.photos
    for (index, mask) in masked.masks.enumerated() {
      for pixel in 0..<240 * 180 where (mask?.pixels[pixel] ?? 0) == 0 {
        photos[index].pixels.replaceSubrange(3 * pixel..<3 * pixel + 3, with: [255, 0, 255])
      }
    }
    func backgroundTexels(_ masks: [RasterImage?]) throws -> Int {
      var options = TextureMapping.Options(textureSide: 256, maps: [.diffuseColor])
      // Without masks, nothing else may exclude these areas.
      if masks.isEmpty { options.candidates.outliers.colorTolerance = .infinity }
      let model = try TextureMapping(options: options).run(
        mesh, dense: mesh, reconstruction: reconstruction,
        images: ImageStore(images: photos, masks: masks), StageContext())
      let texture = try #require(model.atlases[0].maps[.diffuseColor])
      return stride(from: 0, to: texture.pixels.count, by: 3).count {
        Int(texture.pixels[$0]) - Int(texture.pixels[$0 + 1]) > 120
          && texture.pixels[$0 + 2] > 180
      }
    }
    let black = RasterImage(width: 240, height: 180, channels: 1)
    let masks = masked.masks.map { $0 ?? black }
    let (background, without) = (try backgroundTexels(masks), try backgroundTexels([]))
    // Texels at the very edge are interpolated.
    #expect(without > 100)
    #expect(20 * background < without, "\(background) of \(without)")
  }

  @Test func unseenUndersidesAreFilled() {
    var ball = PointCloud()
    for index in 0..<4000 {
      let y = 1 - 2 * (Float(index) + 0.5) / 4000
      let angle = Float(index) * 2.399963
      let r = max(0, 1 - y * y).squareRoot()
      let normal = SIMD3<Float>(r * cos(angle), y, r * sin(angle))
      ball.positions.append(normal)
      ball.normals.append(normal)
      ball.footprints.append(0.02)
      ball.photoOffsets.append(0)
    }
    #expect(SupportPlane(under: ball, in: WorldFrame(up: .cameras)) == nil)
    let upper = ball.filtered(by: ball.positions.map { $0.y > -0.5 })
    let plane = SupportPlane(under: upper, in: WorldFrame(up: .cameras))
    #expect(plane.map { abs($0.offset + 0.5) < 0.02 } == true)
    #expect(SupportPlane(under: upper, in: WorldFrame(up: .unknown)) == nil)
  }
}
