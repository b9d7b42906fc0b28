import Formats
import Foundation
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

/// Photos with exact cameras in, a dense cloud on the true surface out.
@Suite(.endToEnd) struct KnownCamerasTests {
  @Test func pointsOfKnownPosesLieOnTheSurface() throws {
    let set = try KnownPhotoSet()
    let notes = StageNotes()
    let context = StageContext(control: KernelControl(threadCount: 2), notes: notes)
    let images = ImageStore(images: set.scene.views.map(\.image))
    let result = try KnownPoseTriangulation().run(set.cameras(), images: images, context)
    #expect(result.poses == set.scene.reconstruction.poses)
    #expect(result.cameras == set.scene.reconstruction.cameras)
    #expect(result.points.count > 300)
    #expect(result.points.allSatisfy { $0.track.count >= 2 && $0.error < 1.5 })
    let distances = result.points.map { set.scene.distance(to: $0.position) }.sorted()
    // A pixel is 0.01 wide on the ball; the depth of a point is several times less certain.
    #expect(distances[distances.count / 2] < 0.01)
    #expect(distances[distances.count * 95 / 100] < 0.06)
    #expect((notes.counts["consistentMatches"] ?? 0) > 0.8 * (notes.counts["matches"] ?? .infinity))
    #expect(notes.warnings.isEmpty)
  }

  @Test func threadsDoNotChangeThePoints() throws {
    let set = try KnownPhotoSet()
    let images = ImageStore(images: set.scene.views.map(\.image))
    let results = try [1, 2].map { threads in
      try KnownPoseTriangulation().run(
        set.cameras(), images: images,
        StageContext(control: KernelControl(threadCount: threads)))
    }
    #expect(results[0].points == results[1].points)
  }

  /// Inverted poses (world-from-camera instead of camera-from-world) are the most common mistake.
  @Test(arguments: [true, false]) func wrongPosesAreRejected(
    inverted: Bool
  ) throws {
    let set = try KnownPhotoSet()
    var cameras = set.cameras()
    let poses = cameras.poses
    cameras.poses = poses.indices.map { inverted ? poses[$0]?.inverse : poses[($0 * 2 + 1) % 5] }
    let pipeline = set.pipeline(KnownCameras(cameras))
    #expect(throws: PipelineError.self) { _ = try pipeline.align().points.count }
    #expect(pipeline.report.errors.contains { $0.contains("cameras don't fit the photos") })
  }

  @Test func inconsistentPointsAreRejected() throws {
    let set = try KnownPhotoSet()
    var cameras = set.cameras(hasPoints: true)
    for index in cameras.points.indices { cameras.points[index].position *= -3 }
    #expect(throws: PipelineError.self) { try set.pipeline(KnownCameras(cameras)).align() }
  }

  @Test(arguments: [false, true]) func theCloudLiesOnTheSurface(hasPoints: Bool) throws {
    let set = try KnownPhotoSet()
    let checkpoint = set.folder.url.appendingPathComponent("work")
    var cameras = set.cameras(hasPoints: hasPoints)
    cameras.worldFrame.scale = .given
    let pipeline = set.pipeline(KnownCameras(cameras), checkpoint: checkpoint)
    let cloud = try pipeline.densify(for: KnownPhotoSet.specification)
    #expect(try pipeline.align().poses == cameras.poses)
    let distances = set.distances(cloud)
    #expect(distances.count > 10_000)
    // A pixel of the views is 0.02 wide.
    #expect(distances[distances.count / 2] < 0.01)
    #expect(distances[distances.count * 9 / 10] < 0.04)

    let counts = try #require(pipeline.report.stages.last?.counts)
    let sparse = Double(try pipeline.align().points.count)
    #expect((counts["givenPoints"] ?? 0) == 0)
    #expect(counts["points"] == Double(cloud.count))
    #expect(counts["pointsPerSparsePoint"] == Double(cloud.count) / sparse)
    #expect((counts["sparseCoverage"] ?? 0) > 0.6)
    #expect((counts["pointsPerCubicMeter"] ?? 0) > 100)
    #expect(!FileManager.default.fileExists(atPath: checkpoint.path + "/sparse"))
    let written = try PLY.readPointCloud(checkpoint.appendingPathComponent("dense/points.ply"))
    #expect(written.positions == cloud.positions)
  }

  @Test func everyPhotoAndCameraIsAccountedFor() throws {
    let set = try KnownPhotoSet(photos: [0, 1, 2, 3])
    var cameras = set.cameras()
    for index in cameras.photos.indices { cameras.photos[index].name = "left/photo\(index).jpg" }
    cameras.photos[2].name = "left/other.jpg"
    let pipeline = set.pipeline(KnownCameras(cameras))
    let result = try pipeline.align()
    #expect(result.registered == [ID(0), ID(1), ID(3)])
    #expect(result.poses[3] == cameras.poses[3])
    let entries = pipeline.report.photos.map { "\($0.name) \($0.status)" }
    #expect(
      entries == [
        "left/other.jpg missing", "left/photo4.jpg missing", "photo0.jpg registered",
        "photo1.jpg registered", "photo2.jpg notRegistered", "photo3.jpg registered",
      ])
    #expect(pipeline.report.warnings.contains { $0.contains("left/other.jpg, left/photo4.jpg") })
  }

  @Test func tooFewPhotosWithCamerasAreAnError() throws {
    let set = try KnownPhotoSet(photos: [0, 1, 2])
    var cameras = set.cameras()
    cameras.photos[1].name = "b.jpg"
    let error = PipelineError.tooFewCameras(found: 2, needed: 3, photos: 3, cameras: 5)
    let pipeline = set.pipeline(KnownCameras(cameras))
    #expect(throws: error) { try pipeline.align() }
    #expect(pipeline.report.warnings.contains { $0.hasPrefix("photo1.jpg is not used: no camera") })
  }

  @Test func camerasOfAnotherSizeAreScaledOrRejected() throws {
    let set = try KnownPhotoSet()
    var cameras = set.cameras(hasPoints: true)
    let wide = Camera(width: 800, height: 316, focalLength: [462, 462])
    cameras.cameras = [cameras.cameras[0].resized(width: 840, height: 632), wide]
    for index in cameras.points.indices {
      for place in cameras.points[index].track.indices {
        cameras.points[index].track[place].pixel *= 2
      }
    }
    cameras.photos[1].camera = ID(1)
    let pipeline = set.pipeline(KnownCameras(cameras))
    let result = try pipeline.align()
    #expect(result.cameras == set.scene.reconstruction.cameras)
    #expect(result.poses[1] == nil && result.registered.count == 4)
    #expect(result.meanReprojectionError < 1e-9)
    #expect(
      result.unregistered.map(\.reason) == [
        "photo1.jpg is not used: its camera is for 800 × 316 pixels, but the photo has 420 × 316 "
          + "pixels, upright."
      ])
    #expect(
      pipeline.report.details.contains {
        $0.contains("scaled to the size of these photos: photo0.jpg, photo2.jpg")
      })
  }

  /// COLMAP's cameras refer to photos in stored orientation.
  @Test(arguments: [6, 8]) func camerasOfStoredPhotosAreRotated(orientation: Int) throws {
    let set = try KnownPhotoSet(orientation: orientation)
    var cameras = set.cameras(hasPoints: true)
    let (upright, back) = (cameras.cameras[0], [6: 3, 8: 1][orientation] ?? 0)
    let turn = Quaternion(angle: Double(back) * .pi / 2, axis: [0, 0, 1])
    cameras.cameras = [upright.resized(width: 316, height: 420)]
    cameras.cameras[0].focalLength = upright.focalLength
    cameras.poses = cameras.poses.map {
      $0.map { RigidTransform(rotation: turn, translation: .zero) * $0 }
    }
    for index in cameras.points.indices {
      cameras.points[index].track = cameras.points[index].track.map { observation in
        var observation = observation
        let (camera, pose) = (cameras.cameras[0], cameras.poses[observation.photo.index])
        observation.pixel = camera.project((pose ?? .identity) * cameras.points[index].position)
        return observation
      }
    }
    let pipeline = set.pipeline(KnownCameras(cameras))
    let result = try pipeline.align()
    #expect(result.meanReprojectionError < 1e-9)
    let cloud = try pipeline.densify(for: KnownPhotoSet.specification)
    let distances = set.distances(cloud)
    #expect(distances.count > 10_000 && distances[distances.count / 2] < 0.01)
    #expect(pipeline.report.details.contains { $0.contains("rotated upright") })
  }
}
