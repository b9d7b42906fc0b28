import Foundation
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

@Suite struct FeatureExtractionTests {
  static func photos(of images: [RasterImage]) -> [Photo] {
    images.enumerated().map { index, image in
      Photo(
        id: ID(index), sampleID: index, name: "\(index).png",
        url: URL(fileURLWithPath: "/\(index).png"), width: image.width, height: image.height,
        orientation: 1, camera: ID(0))
    }
  }

  static func features(
    _ images: [RasterImage], _ options: FeatureExtraction.Options, threads: Int = 1
  ) throws -> [FeatureSet] {
    try FeatureExtraction(options).run(
      photos(of: images), images: ImageStore(images: images),
      StageContext(control: KernelControl(threadCount: threads)))
  }

  /// Positions and scales refer to the full-size photo even if the photo is searched at half its
  /// size.
  @Test func reducedPhotoKeepsFullSizeCoordinates() throws {
    let image = TexturePattern.image(width: 640, height: 480, seed: 3)
    var options = FeatureExtraction.Options()
    options.sparseFeatures = 0
    let full = try Self.features([image], options)[0]
    options.maximumPixels = 320 * 240
    let reduced = try Self.features([image], options)[0]
    #expect(reduced.count > 50)
    let errors = reduced.positions.indices.map { index in
      full.positions.indices.filter {
        abs(log2(full.scales[$0] / reduced.scales[index])) < 0.4
      }.map { (full.positions[$0] - reduced.positions[index]).length }.min() ?? .infinity
    }
    #expect(errors.sorted()[errors.count / 4] < 0.2)
  }

  @Test func largePhotosAreNotUpsampled() throws {
    let image = TexturePattern.image(width: 400, height: 300, seed: 4)
    var options = FeatureExtraction.Options()
    options.sparseFeatures = 0
    options.detection.sufficientFeatures = .max
    let doubled = try Self.features([image], options)[0]
    options.doubledPixels = 400 * 300 - 1
    let plain = try Self.features([image], options)[0]
    // The first octave begins at a blur of 1.6 pixels: of the upsampled photo or of the original.
    #expect(try #require(doubled.scales.last) < 1.3)
    #expect(try #require(plain.scales.last) > 1.6)
    #expect(doubled.count > plain.count)
  }

  @Test func threadsDoNotMatter() throws {
    let images = (0..<4).map { TexturePattern.image(width: 240, height: 180, seed: $0) }
    let one = try Self.features(images, .init())
    let two = try Self.features(images, .init(), threads: 2)
    #expect(one.map(\.descriptors) == two.map(\.descriptors))
    #expect(one.map(\.positions) == two.map(\.positions))
  }

  /// For a statue with hardly any texture, high sensitivity yields more photos or more points, with
  /// correct poses.
  @Test(.endToEnd) func highSensitivityRegistersMoreOfAFaintObject() throws {
    var scene = RenderedScene.faintStatue()
    let noise = scene.noise
    scene = scene.seen(from: Array(scene.poses.prefix(8)))
    (scene.noise, scene.samplesPerSide) = (noise, 1)
    let control = KernelControl(threadCount: 2)
    let images = try scene.photos(control)
    func align(isHigh: Bool) -> Reconstruction? {
      var options = ImageAlignment.Options()
      options.features.sensitivity = isHigh ? .high : .normal
      return try? ImageAlignment(options).run(
        photos: Self.photos(of: images), cameras: [scene.camera],
        images: ImageStore(images: images), StageContext(control: control))
    }
    let normal = align(isHigh: false)
    let high = try #require(align(isHigh: true))
    let photos = (normal: normal?.registered.count ?? 0, high: high.registered.count)
    let points = (normal: normal?.points.count ?? 0, high: high.points.count)
    #expect(photos.high >= photos.normal)
    #expect(
      photos.high > photos.normal || 100 * points.high >= 115 * points.normal,
      "photos \(photos), points \(points)")
    let poses = PoseComparison(estimated: high.poses, true: scene.poses)
    #expect(poses.maximumRotationError < 0.05 && poses.maximumCenterError < 0.03)
  }
}
