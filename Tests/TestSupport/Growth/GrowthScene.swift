import Foundation
import Kernels
import SceneModel

/// Features of up to thousands of photos of a textured world with known ground truth, without
/// pixels.
///
/// Unlike in `SyntheticScene`, a photo observes a small part of the world: points that are near, in
/// view, large enough to be detected, facing the camera and not occluded. Descriptors resemble
/// those of similar texture elsewhere and change with the viewing angle and distance, and some
/// features have no counterpart in any photo, so that pair selection and matching are as hard as
/// with real photos.
package struct GrowthScene: Sendable {
  /// The arrangement of the cameras.
  package enum Layout: String, Sendable, CaseIterable {
    /// A car drives through all streets of a town of square blocks; its cameras face forward,
    /// alternately to the left and to the right. The town grows with the number of photos.
    case streets
    /// Rings of cameras around one object, from low to high.
    case orbits
  }

  package struct Options: Sendable {
    package var layout = Layout.streets
    package var photoCount = 50
    /// Maximum number of features per photo, including those without a counterpart.
    package var featuresPerPhoto = 2500
    /// Fraction of the features of a photo that no other photo shows.
    package var clutterRatio = 0.2
    /// Standard deviation of the keypoints in pixels.
    package var pixelNoise = 0.5
    /// Shuffles the photos instead of keeping the order of capture.
    package var isShuffled = false
    package var camera = Camera(width: 1200, height: 900, focalLength: [900, 900])
    package var seed: UInt64 = 1

    package init() {}
  }

  package let options: Options
  package let photos: [Photo]
  /// The true `cameraFromWorld`.
  package let poses: [RigidTransform]
  /// Sorted by scale in descending order.
  package let features: [FeatureSet]
  /// The point of every feature, −1 if there is none.
  package let pointOfFeature: [[Int32]]

  /// The true camera.
  package var camera: Camera { options.camera }

  package init(_ options: Options = Options(), _ control: KernelControl = KernelControl()) throws {
    self.options = options
    var random = SeededGenerator(seed: options.seed)
    let world = GrowthWorld(options, &random)
    var poses = world.poses
    if options.isShuffled { poses.shuffle(using: &random) }
    self.poses = poses
    photos = poses.indices.map { index in
      let name = String(format: "photo%05d.jpg", index)
      return Photo(
        id: ID(index), sampleID: index, name: name, url: URL(fileURLWithPath: "/" + name),
        width: options.camera.width, height: options.camera.height, orientation: 1,
        camera: ID<Camera>(0))
    }
    let descriptors = GrowthDescriptors(&random)
    let seed = random.next()
    let seen = try control.parallelMap(poses.count) { [poses] index in
      var random = SeededGenerator(seed: seed &+ UInt64(index))
      return GrowthView(world, poses[index], options).features(descriptors, &random)
    }
    features = seen.map(\.features)
    pointOfFeature = seen.map(\.points)
  }

  /// The number of points shared by each pair of photos, for pairs with at least `minimum`.
  package func overlaps(minimum: Int) -> [PhotoPair: Int] {
    var photosOfPoint: [Int32: [Int32]] = [:]
    for (photo, points) in pointOfFeature.enumerated() {
      for point in points where point >= 0 {
        photosOfPoint[point, default: []].append(Int32(photo))
      }
    }
    var counts = [Int32](repeating: 0, count: photos.count * photos.count)
    for photos in photosOfPoint.values {
      for (index, first) in photos.enumerated() {
        for second in photos[(index + 1)...] {
          counts[Int(first) * self.photos.count + Int(second)] += 1
        }
      }
    }
    var overlaps: [PhotoPair: Int] = [:]
    for (index, count) in counts.enumerated() where count >= max(1, minimum) {
      overlaps[PhotoPair(ID(index / photos.count), ID(index % photos.count))] = Int(count)
    }
    return overlaps
  }
}
