import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MaskEstimationTests {
  /// Photos of a bright sphere with radius 1 before darkness, and points of a part of it.
  private struct Sphere {
    private static let size = 160
    let points: [SIMD3<Float>]
    var views: [MaskingView] = []
    /// The exact masks.
    let masks: [RasterImage]

    /// The points are below the height `top`.
    init(top: Float = .infinity) throws {
      let surface = SyntheticMesh.sphere(subdivisions: 4).positions
      points = surface.filter { $0.y < top }
      let scene = SphereScene(viewCount: 13, imageSize: Self.size) { _ in SIMD3(200, 190, 180) }
      masks = scene.images.map { image in image.gray.marking { $0 > 100 } }
      // What is above hides the points behind it.
      let discs = Discs(
        positions: surface, radii: surface.map { _ in 0.042 },
        labels: surface.map { $0.y < top ? PointLabel.object : PointLabel.surroundings })
      views = try scene.reconstruction.registered.map { id in
        let photo = try ReducedPhoto(id, scene.reconstruction, scene.images[id.index])
        var labels = try discs.drawn(
          by: photo.camera, at: photo.cameraFromWorld, KernelControl())
        for pixel in labels.pixels.indices where labels.pixels[pixel] != PointLabel.object {
          labels.pixels[pixel] = 0
        }
        return try Self.view(photo, labels)
      }
    }

    private static func view(_ photo: ReducedPhoto, _ labels: RasterImage) throws -> MaskingView {
      try MaskingView(photo, labels, rim: 3, reach: 0.3)
    }

    /// Labels the sphere in a view as surroundings, and a corner of the photo as object.
    mutating func mislabel(_ index: Int) throws {
      let size = Self.size
      var labels = masks[index]
      for pixel in labels.pixels.indices {
        let isCorner = pixel % size < 20 && pixel / size < 20
        labels.pixels[pixel] =
          labels.pixels[pixel] != 0
          ? PointLabel.surroundings : isCorner ? PointLabel.object : 0
      }
      views[index] = try Self.view(views[index].photo, labels)
    }

    func estimated(
      _ options: MaskEstimation.Options = MaskEstimation.Options(),
      _ control: KernelControl = KernelControl(threadCount: 2)
    ) throws -> MaskEstimation.Result {
      try MaskEstimation(options: options).run(
        views, points: points, StageContext(control: control))
    }

    /// Intersection over union with the exact masks.
    func accuracy(of masks: [RasterImage]) -> [Double] {
      zip(masks, self.masks).map { $0.intersectionOverUnion(with: $1) }
    }
  }

  @Test func labelsBecomeExactMasks() throws {
    let sphere = try Sphere()
    let result = try sphere.estimated()
    let accuracy = sphere.accuracy(of: result.masks)
    #expect(accuracy.allSatisfy { $0 > 0.97 }, "\(accuracy)")
    #expect(result.agreement.allSatisfy { $0 > 0.9 }, "\(result.agreement)")
    #expect(result.masks.count == 13 && result.agreement.count == 13)
    #expect(result.masks.allSatisfy { $0.pixels.allSatisfy { $0 == 0 || $0 == 255 } })
  }

  /// No point is known of the top of the sphere, which is in the middle of the first photo.
  @Test func masksFollowColorsBeyondTheLabels() throws {
    let sphere = try Sphere(top: 0.85)
    let labels = sphere.views.map { view in view.labels.marking { $0 != 0 } }
    #expect(sphere.accuracy(of: labels)[0] < 0.7)
    var options = MaskEstimation.Options()
    // Masks don't follow edges then.
    options.cut.smoothness = 0
    for options in [MaskEstimation.Options(), options] {
      let accuracy = sphere.accuracy(of: try sphere.estimated(options).masks)
      #expect(accuracy.allSatisfy { $0 > 0.95 }, "\(accuracy)")
    }
    // Without colors, masks are the outlines of the discs, which extend beyond the sphere.
    options.colorWeight = 0
    let colorless = sphere.accuracy(of: try sphere.estimated(options).masks)
    #expect(colorless.allSatisfy { $0 < 0.9 }, "\(colorless)")
  }

  @Test func wrongLabelsOfAViewDoNotAgree() throws {
    var sphere = try Sphere()
    try sphere.mislabel(5)
    let result = try sphere.estimated()
    #expect(result.agreement[5] < 0.5)
    let others = result.agreement.indices.filter { $0 != 5 }
    #expect(others.allSatisfy { result.agreement[$0] > 0.9 }, "\(result.agreement)")
    let accuracy = sphere.accuracy(of: result.masks)
    #expect(others.allSatisfy { accuracy[$0] > 0.95 }, "\(accuracy)")
  }

  @Test func threadsDoNotChangeTheMasks() throws {
    let sphere = try Sphere(top: 0.85)
    let results = try [1, 3].map { try sphere.estimated(.init(), KernelControl(threadCount: $0)) }
    let areEqual = results[0].masks == results[1].masks
    #expect(areEqual)
    #expect(results[0].agreement == results[1].agreement)
  }

  /// At the start, in the first round, and in the second one.
  @Test(arguments: [0, 0.2, 0.5, 0.9]) func cancellationStops(fraction: Double) throws {
    let sphere = try Sphere()
    let flag = CancellationFlag()
    let control = KernelControl(flag: flag) { if $0 >= fraction { flag.cancel() } }
    #expect(throws: CancellationError.self) { try sphere.estimated(.init(), control) }
  }
}
