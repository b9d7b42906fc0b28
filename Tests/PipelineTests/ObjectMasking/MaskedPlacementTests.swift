import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MaskedPlacementTests {
  /// A sphere with radius 1, and the place of this world in the frame of the placement.
  private let scene = SphereScene(viewCount: 8, imageSize: 60) { _ in SIMD3(200, 190, 180) }
  private let placementFromWorld = SimilarityTransform(
    scale: 2.5, rotation: Quaternion(angle: 1.2, axis: [0.6, 0, 0.8]), translation: [3, -7, 4])
  private let points: [SIMD3<Float>] = [[0, 1, 0], [0.6, 0, 0.8], [0, 0, -3]]

  /// The placement of some photos.
  private func placement(of photos: [Int]) -> MaskedPlacement {
    var masks = ObjectMasking.Result(photoCount: 8)
    masks.points = LabeledCloud(
      cloud: PointCloud(
        positions: points.map { SIMD3<Float>(placementFromWorld * SIMD3<Double>($0)) },
        normals: points.map { _ in [0, 1, 0] }, colors: points.map { _ in [1, 2, 3] },
        consistency: points.map { _ in 1 }, footprints: points.map { _ in 0.5 },
        photoOffsets: points.map { _ in 0 } + [0]),
      isObject: [true, true, false])
    return MaskedPlacement(
      photos: photos,
      poses: scene.reconstruction.poses.indices.map { photo in
        guard photos.contains(photo), let pose = scene.reconstruction.poses[photo] else {
          return nil
        }
        return placementFromWorld.applied(toCameraFromA: pose)
      }, masks: masks)
  }

  /// The photos, with masks of the sphere where they are of the group.
  private func images(maskedIn group: [Int]) -> ImageStore {
    ImageStore(
      images: scene.images,
      masks: scene.images.indices.map { photo in
        group.contains(photo) ? scene.images[photo].gray.marking { $0 > 100 } : nil
      })
  }

  /// The reconstruction without the poses of some photos.
  private func joined(without missing: [Int]) -> Reconstruction {
    var result = scene.reconstruction
    for photo in missing { result.poses[photo] = nil }
    return result
  }

  @Test func pointsAreTransformedIntoTheJoinedFrame() throws {
    let photos = [0, 2, 3, 5, 6]
    let prior = try #require(
      try placement(of: photos).prior(
        in: joined(without: [4, 6]), images(maskedIn: photos)))
    #expect(prior.photos == Set(photos))
    #expect(prior.points.isObject == [true, true, false])
    for (found, point) in zip(prior.points.cloud.positions, points) {
      #expect((found - point).length < 1e-5)
    }
    #expect(prior.points.cloud.footprints.allSatisfy { abs($0 - 0.2) < 1e-6 })
  }

  /// Masks of other placements don't count, although photos 1 and 7 have some.
  @Test func silhouettesAreThoseOfItsPhotos() throws {
    let photos = [0, 2, 3, 5, 6]
    let prior = try #require(
      try placement(of: photos).prior(
        in: joined(without: []), images(maskedIn: [0, 1, 2, 3, 7])))
    #expect(prior.silhouettes.share == 0.6)
    #expect(try prior.silhouettes.isInside([0, 0.9, 0]))
    #expect(try !prior.silhouettes.isInside([0, 1.25, 0]))
  }

  /// Two photos don't determine how the placement stands in the joined frame.
  @Test(arguments: [([6], true), ([0, 6], true), ([0, 5, 6], false), (Array(0..<8), false)])
  func enoughPhotosMustBeJoined(missing: [Int], isEnough: Bool) throws {
    let photos = [0, 2, 3, 5, 6]
    let prior = try placement(of: photos).prior(
      in: joined(without: missing), images(maskedIn: photos))
    #expect((prior != nil) == isEnough)
  }

  @Test func withoutMasksThereIsNoPrior() throws {
    let photos = [0, 2, 3, 5, 6]
    #expect(
      try placement(of: photos).prior(in: joined(without: []), images(maskedIn: [1, 4])) == nil)
  }
}
