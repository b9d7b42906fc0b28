import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ObservationRefinementTests {
  private static let scene: RaycastScene = {
    var options = RaycastScene.Options()
    (options.viewCount, options.width, options.height) = (7, 240, 180)
    return RaycastScene(options)
  }()

  /// The exact reconstruction with noise of `noise` pixels added to the observations, re-adjusted.
  private static func perturbed(
    by noise: Double, dropping isDropped: (Int, Int) -> Bool = { _, _ in false }
  ) throws -> Reconstruction {
    var random = SeededGenerator(seed: 3)
    var result = scene.reconstruction
    for point in result.points.indices {
      let track = result.points[point].track.filter { !isDropped(point, $0.photo.index) }
      result.points[point].track = track.map { observation in
        var moved = observation
        moved.pixel += noise * SIMD2(random.normal(), random.normal())
        return moved
      }
    }
    result.points.removeAll { $0.track.count < 2 }
    var map = SparseMap(result)
    try MapAdjustment(initialCameras: result.cameras)
      .adjustGlobally(&map, isFinal: true, KernelControl())
    return try map.reconstruction(
      like: result, features: features(result), KernelControl())
  }

  private static func features(_ reconstruction: Reconstruction) -> [FeatureSet] {
    reconstruction.photos.map { _ in
      FeatureSet(positions: [], scales: [], orientations: [], descriptors: [], colors: [])
    }
  }

  private func refined(_ reconstruction: Reconstruction, threads: Int = 1) throws -> Reconstruction
  {
    try ObservationRefinement().run(
      reconstruction, features: Self.features(reconstruction),
      cameras: Self.scene.reconstruction.cameras,
      images: ImageStore(images: Self.scene.views.map(\.image)),
      StageContext(control: KernelControl(threadCount: threads)))
  }

  @Test func posesBecomeMoreAccurate() throws {
    let rough = try Self.perturbed(by: 0.4)
    let fine = try refined(rough)
    let truth = Self.scene.reconstruction.poses.compactMap { $0 }
    let before = PoseComparison(estimated: rough.poses, true: truth)
    let after = PoseComparison(estimated: fine.poses, true: truth)
    #expect(after.maximumCenterError < before.maximumCenterError / 2)
    // Errors of the principal point compensate for part of the improvement of the rotations.
    #expect(after.maximumRotationError < before.maximumRotationError)
    #expect(fine.meanReprojectionError < 0.15)
    #expect(fine.points.count > rough.points.count * 3 / 4)
  }

  @Test func missedObservationsAreFound() throws {
    // Every other photo lacks the observations of every other point.
    let rough = try Self.perturbed(by: 0.2) { point, photo in point % 2 == 0 && photo % 2 == 0 }
    let fine = try refined(rough)
    let new = fine.points.flatMap { point in
      point.track.filter { $0.feature == SparseMap.noFeature }.map { (point.position, $0) }
    }
    let counts = [Self.scene.reconstruction, rough].map {
      $0.points.reduce(0) { $0 + $1.track.count }
    }
    #expect(new.count > (counts[0] - counts[1]) / 3)
    for (position, observation) in new {
      let pixel = fine.camera(of: observation.photo)
        .project(fine.poses[observation.photo.index]! * position)
      #expect((pixel - observation.pixel).length < 2)
    }
    for point in fine.points {
      #expect(Set(point.track.map(\.photo)).count == point.track.count)
    }
  }

  @Test func threadsDoNotMatter() throws {
    let rough = try Self.perturbed(by: 0.3)
    let (one, two) = (try refined(rough), try refined(rough, threads: 2))
    #expect(one.poses == two.poses)
    #expect(one.points == two.points)
    #expect(one.cameras == two.cameras)
  }

  @Test func contradictingPhotoIsReported() throws {
    var rough = try Self.perturbed(by: 0.2)
    // All observations of this photo are displaced, each in a different direction.
    let stray = 3
    var random = SeededGenerator(seed: 5)
    for point in rough.points.indices {
      for index in rough.points[point].track.indices
      where rough.points[point].track[index].photo.index == stray {
        rough.points[point].track[index].pixel += 20 * SIMD2(random.normal(), random.normal())
      }
    }
    let result = try refined(rough)
    #expect(result.poses[stray] == nil)
    #expect(result.unregistered.map(\.name) == [rough.photos[stray].name])
    #expect(result.registered.count == rough.registered.count - 1)
    #expect(
      result.points.allSatisfy { point in
        point.track.count > 1 && point.track.allSatisfy { $0.photo.index != stray }
      })
  }

  @Test func photosWithoutTextureKeepTheirObservations() throws {
    let rough = try Self.perturbed(by: 0.2)
    let blank = Self.scene.views.map {
      RasterImage(width: $0.image.width, height: $0.image.height, channels: 3, filledWith: 128)
    }
    let result = try ObservationRefinement().run(
      rough, features: Self.features(rough), cameras: rough.cameras,
      images: ImageStore(images: blank), StageContext())
    #expect(result.registered == rough.registered)
    #expect(result.points.count > rough.points.count * 3 / 4)
  }
}
