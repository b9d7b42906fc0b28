import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct VisualHullTests {
  /// Photos of a sphere with radius 1 from all sides, with exact masks.
  private struct Sphere {
    let points = SyntheticMesh.sphere(subdivisions: 4).positions
    let views: [MaskingView]
    var masks: [RasterImage]

    init() throws {
      let scene = SphereScene(viewCount: 13, imageSize: 300) { _ in SIMD3(200, 190, 180) }
      let discs = Discs(
        positions: points, radii: points.map { _ in 0.05 },
        labels: points.map { _ in PointLabel.object })
      views = try scene.reconstruction.registered.map { id in
        let photo = try ReducedPhoto(id, scene.reconstruction, scene.images[id.index])
        let labels = try discs.drawn(
          by: photo.camera, at: photo.cameraFromWorld, KernelControl())
        return try MaskingView(photo, labels, rim: 2, reach: 0.1)
      }
      masks = scene.images.map { image in image.gray.marking { $0 > 100 } }
    }

    func hull(
      _ options: VisualHull.Options = VisualHull.Options(), threads: Int = 2
    ) throws -> VisualHull {
      try VisualHull(
        of: views, masks: masks, around: points, options: options,
        KernelControl(threadCount: threads))
    }
  }

  @Test func theHullContainsTheObjectClosely() throws {
    let sphere = try Sphere()
    let hull = try sphere.hull()
    for (view, mask) in zip(sphere.views, sphere.masks) {
      let silhouette = try hull.silhouette(in: view, KernelControl())
      let isCovered = zip(mask.pixels, silhouette.pixels).allSatisfy { $0 == 0 || $1 != 0 }
      #expect(isCovered)
      #expect(mask.intersectionOverUnion(with: silhouette) > 0.9)
    }
    // The discs cover the surface of the hull; between cameras it is farther away than the sphere.
    let distances = hull.discs.positions.map(\.length)
    #expect(distances.allSatisfy { $0 > 0.95 })
    #expect(distances.reduce(0, +) / Float(distances.count) < 1.1)
    #expect(hull.discs.labels.allSatisfy { $0 == PointLabel.object })
  }

  @Test func someMasksMayBeWrong() throws {
    var sphere = try Sphere()
    sphere.masks[5] = RasterImage(width: 300, height: 300, channels: 1)
    var options = VisualHull.Options()
    options.resolution = 40
    let tolerant = try sphere.hull(options).discs.positions
    // Photo 5 shows nothing: without tolerance only what is outside of its frame remains.
    options.minimumShare = 1
    let strict = try sphere.hull(options).discs.positions
    #expect(strict.count < tolerant.count)
    #expect(strict.allSatisfy { !sphere.views[5].photo.isInFrame($0) })
  }

  @Test func threadsDoNotChangeTheHull() throws {
    let sphere = try Sphere()
    var options = VisualHull.Options()
    options.resolution = 40
    let hulls = try [1, 3].map { try sphere.hull(options, threads: $0).discs.positions }
    #expect(hulls[0] == hulls[1] && !hulls[0].isEmpty)
  }

  @Test func withoutPointsThereIsNoHull() throws {
    let sphere = try Sphere()
    let hull = try VisualHull(
      of: sphere.views, masks: sphere.masks, around: [], options: VisualHull.Options(),
      KernelControl())
    #expect(hull.discs.positions.isEmpty)
    let silhouette = try hull.silhouette(in: sphere.views[0], KernelControl())
    #expect(silhouette.pixels.allSatisfy { $0 == 0 })
  }
}

extension ReducedPhoto {
  fileprivate func isInFrame(_ point: SIMD3<Float>) -> Bool {
    let seen = cameraFromWorld * SIMD3<Double>(point)
    return seen.z > 0 && camera.contains(camera.project(seen))
  }
}
