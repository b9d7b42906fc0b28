import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MaskPriorTests {
  private func prior(at positions: [SIMD2<Float>]) -> MaskPrior {
    var graph = ViewGraph(photoCount: 1, pairs: [])
    graph.surroundings = [positions.map { _ in true } + [false]]
    let features = FeatureSet(
      positions: positions + [[50, 50]], scales: [Float](repeating: 4, count: positions.count + 1),
      orientations: [], descriptors: [], colors: [])
    return MaskPrior(graph, features: [features])
  }

  private func drawn(_ prior: MaskPrior, maximumRadius: Float = 10) -> RasterImage {
    var labels = RasterImage(width: 50, height: 40, channels: 1)
    prior.drawFeatures(
      of: ID(0), full: [100, 80], radius: 1.5, maximumRadius: maximumRadius, into: &labels)
    return labels
  }

  /// Photos are drawn at half their size, and features as discs of 1.5 scales: three pixels.
  @Test func featuresOfTheSurroundingsAreDiscs() {
    let labels = drawn(prior(at: [[20, 30]]))
    for y in 0..<40 {
      for x in 0..<50 {
        let offset = SIMD2(Float(x), Float(y)) + 0.5 - [10, 15]
        let isInside = (offset * offset).sum() <= 9
        #expect(labels.pixels[y * 50 + x] == (isInside ? PointLabel.surroundings : 0))
      }
    }
  }

  @Test func largeFeaturesAreLimited() {
    let labels = drawn(prior(at: [[20, 30]]), maximumRadius: 1)
    #expect(labels.pixels.count { $0 != 0 } == 4)
  }

  @Test(arguments: [[-40, 10], [500, 10], [10, -40], [10, 500]] as [SIMD2<Float>])
  func featuresOutsideThePhotoAreNotDrawn(position: SIMD2<Float>) {
    #expect(drawn(prior(at: [position])).pixels.allSatisfy { $0 == 0 })
  }

  @Test func photosWithoutAPriorKeepTheirLabels() {
    var labels = RasterImage(width: 2, height: 1, channels: 1)
    labels.pixels = [PointLabel.object, 0]
    MaskPrior().drawFeatures(
      of: ID(3), full: [2, 1], radius: 1, maximumRadius: 1, into: &labels)
    #expect(labels.pixels == [PointLabel.object, 0])
  }

  // MARK: An object that was moved

  /// Photos 0 to 3 and 4 to 7 are of two placements. Their masks contain nothing, and no placement
  /// has a point near by.
  @Test(
    arguments: [
      ([0, 1, 4, 5], true), ([2, 3, 5, 6, 7], true), ([0, 1, 2, 3], false), ([0, 1, 2, 7], false),
    ] as [([UInt16], Bool)])
  func pointThatTwoPlacementsShowIsOfTheObject(photos: [UInt16], isObject: Bool) throws {
    let scene = RenderedScene.statue(photoCount: 8, upperCount: 0, width: 60, height: 45)
    let image = RasterImage(width: 60, height: 45, channels: 3)
    let images = ImageStore(
      images: scene.poses.map { _ in image },
      masks: scene.poses.map { _ in RasterImage(width: 60, height: 45, channels: 1) })
    let silhouettes = try #require(try Silhouettes(scene.reconstruction(), images: images))
    var prior = MaskPrior()
    prior.placements = [Set(0...3), Set(4...7)].map { photos in
      MaskPrior.Placement(
        photos: photos, silhouettes: silhouettes,
        points: LabeledCloud(cloud: cloud(at: [0, 9, 0], seenBy: []), isObject: [true]))
    }
    let labeled = try prior.object(
      in: cloud(at: [0, 0.1, 0], seenBy: photos), tolerance: 1, KernelControl())
    #expect(labeled.isObject == [isObject])
  }

  private func cloud(at position: SIMD3<Float>, seenBy photos: [UInt16]) -> PointCloud {
    var cloud = PointCloud()
    cloud.positions = [position]
    cloud.normals = [[0, 1, 0]]
    cloud.colors = [[128, 128, 128]]
    cloud.consistency = [1]
    cloud.footprints = [0.01]
    cloud.photoIndices = photos
    cloud.photoOffsets.append(UInt32(photos.count))
    return cloud
  }
}
