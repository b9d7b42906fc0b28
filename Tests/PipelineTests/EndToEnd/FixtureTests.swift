import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

@Suite struct FixtureTests {
  @Test func unusableFilesAreRejectedAndTheOthersUsed() throws {
    let result = try PhotoIngestion().run(folder: Fixtures.folder("bad"), StageContext())
    let faults = Dictionary(uniqueKeysWithValues: result.rejected.map { ($0.name, $0.fault) })
    #expect(
      faults == [
        "black.jpg": .blank, "blurred.jpg": .blurred, "corrupt.jpg": .unreadable,
        "empty.jpg": .unreadable, "notes.txt": .unsupportedFormat,
        "recoded.jpg": .duplicate, "text-named-as.jpg": .unsupportedFormat,
        "tiny.png": .tooSmall, "truncated.jpg": .unreadable,
      ])
    #expect(
      result.photos.map(\.name) == ["orientation-6.jpg", "original.jpg", "png-named.jpg"])
    #expect(result.photos.map(\.width) == [480, 480, 360])
  }

  @Test func rendersAreAcceptedWithTheirCameras() throws {
    let orbit = try PhotoIngestion().run(folder: Fixtures.images(of: "orbit"), StageContext())
    #expect(orbit.photos.count == 20)
    #expect(orbit.cameras.count == 1)
    #expect(abs(orbit.cameras[0].focalLength.x - 920) < 1e-6)
    #expect(orbit.cameras[0].calibration == .exif)
    let relief = try PhotoIngestion().run(folder: Fixtures.images(of: "relief"), StageContext())
    #expect(relief.photos.count == 12)
    #expect(relief.cameras.map(\.calibration) == [.assumed])
  }

  @Test func renderedPointsLieOnTheRenderedDepth() throws {
    let scene = RenderedScene.statue(photoCount: 4, upperCount: 1, width: 200, height: 150)
    let reconstruction = scene.reconstruction(pointCount: 300)
    #expect(reconstruction.points.count > 100)
    #expect(reconstruction.meanReprojectionError < 1e-9)
    for photo in scene.poses.indices {
      let depth = scene.depth(photo)
      var errors: [Double] = []
      for point in reconstruction.points {
        guard let seen = point.track.first(where: { $0.photo.index == photo }) else { continue }
        let z = (scene.poses[photo] * point.position).z
        let rows = max(0, Int(seen.pixel.y) - 1)...min(149, Int(seen.pixel.y) + 1)
        let columns = max(0, Int(seen.pixel.x) - 1)...min(199, Int(seen.pixel.x) + 1)
        // The nearest of the surrounding pixels, because depth jumps at occlusion boundaries.
        let nearest = rows.flatMap { y in columns.map { x in abs(Double(depth[y * 200 + x]) - z) } }
        errors.append(nearest.min() ?? .infinity)
      }
      #expect(errors.count > 30)
      #expect(errors.sorted()[errors.count * 9 / 10] < 0.008)
    }
  }

  /// Lambertian surfaces: a point has nearly the same color in all photos.
  @Test(.endToEnd) func colorsAgreeBetweenRenders() throws {
    var scene = RenderedScene.relief(photoCount: 3, width: 240, height: 180)
    scene.noise = 0
    let images = try scene.photos()
    #expect(try scene.photos(KernelControl(threadCount: 2)) == images)
    var differences: [Int] = []
    for point in scene.reconstruction(pointCount: 400).points where point.track.count == 3 {
      let values = point.track.map { seen in
        Int(images[seen.photo.index].pixels[(Int(seen.pixel.y) * 240 + Int(seen.pixel.x)) * 3])
      }
      differences.append((values.max() ?? 0) - (values.min() ?? 0))
    }
    #expect(differences.count > 100)
    #expect(differences.sorted()[differences.count / 2] < 20)
  }
}
