import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct GrowthSceneTests {
  static func scene(
    _ layout: GrowthScene.Layout, photos: Int = 12, isShuffled: Bool = false, threads: Int = 1
  ) throws -> GrowthScene {
    var options = GrowthScene.Options()
    (options.layout, options.photoCount, options.isShuffled) = (layout, photos, isShuffled)
    options.featuresPerPhoto = 600
    return try GrowthScene(options, KernelControl(threadCount: threads))
  }

  @Test(arguments: GrowthScene.Layout.allCases)
  func neighboringPhotosOverlap(layout: GrowthScene.Layout) throws {
    let scene = try Self.scene(layout, photos: 40)
    for (set, points) in zip(scene.features, scene.pointOfFeature) {
      #expect((300...600).contains(set.count) && points.count == set.count)
      #expect(set.descriptors.count == set.count * FeatureSet.descriptorLength)
      #expect(zip(set.scales, set.scales.dropFirst()).allSatisfy { $0 >= $1 })
      #expect(Set(points.filter { $0 >= 0 }).count == points.count { $0 >= 0 })
      let clutter = Double(points.count { $0 < 0 }) / Double(points.count)
      #expect(abs(clutter - scene.options.clutterRatio) < 0.02)
    }
    let overlaps = scene.overlaps(minimum: 40)
    let step = layout == .streets ? 2 : 1
    let shared = try #require(overlaps[PhotoPair(ID(0), ID(step))])
    #expect(shared >= 40 && shared <= scene.features[0].count)
    #expect(shared > overlaps[PhotoPair(ID(0), ID(step + 10))] ?? 0)
  }

  @Test(arguments: GrowthScene.Layout.allCases)
  func descriptorsOfNearbyViewsAreMatched(layout: GrowthScene.Layout) throws {
    let scene = try Self.scene(layout, photos: 40)
    let step = layout == .streets ? 2 : 1
    let matches = try DescriptorMatching().matches(
      scene.features[0], scene.features[step], KernelControl())
    let right = matches.count {
      let points = (
        scene.pointOfFeature[0][Int($0.first)], scene.pointOfFeature[step][Int($0.second)]
      )
      return points.0 >= 0 && points.0 == points.1
    }
    #expect(right > 40 && right * 10 > matches.count * 9)
  }

  @Test func threadsDoNotMatter() throws {
    let (one, two) = (try Self.scene(.streets), try Self.scene(.streets, threads: 2))
    #expect(one.features.map(\.descriptors) == two.features.map(\.descriptors))
    #expect(one.features.map(\.positions) == two.features.map(\.positions))
    #expect(one.poses == two.poses && one.pointOfFeature == two.pointOfFeature)
  }

  @Test func shuffledPhotosAreTheSameCameras() throws {
    let sorted = try Self.scene(.orbits)
    let shuffled = try Self.scene(.orbits, isShuffled: true)
    #expect(sorted.poses != shuffled.poses)
    #expect(shuffled.poses.allSatisfy { sorted.poses.contains($0) })
  }
}
