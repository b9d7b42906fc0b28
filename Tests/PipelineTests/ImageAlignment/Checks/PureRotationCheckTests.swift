import Foundation
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

@Suite struct PureRotationCheckTests {
  private func isPureRotation(_ options: SyntheticScene.Options, focalFactor: Double = 1) -> Bool {
    let scene = SyntheticScene(options)
    var camera = scene.camera
    camera.focalLength *= focalFactor
    camera.calibration = focalFactor == 1 ? .exif : .assumed
    return PureRotationCheck().isPureRotation(
      scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [camera])
  }

  @Test(.endToEnd, arguments: SyntheticScene.Layout.allCases, [1, 0.7])
  func translationIsNotPureRotation(layout: SyntheticScene.Layout, focalFactor: Double) {
    var options = SyntheticScene.Options()
    (options.layout, options.pixelNoise) = (layout, 0.5)
    #expect(!isPureRotation(options, focalFactor: focalFactor))
    options.isPlanar = true
    #expect(!isPureRotation(options, focalFactor: focalFactor))
  }

  /// Points around a camera that rotates sideways by `angle` radians.
  @Test(arguments: [1, 1.4]) func pureRotationIsDetected(focalFactor: Double) {
    var random = SeededGenerator(seed: 5)
    let camera = Camera(width: 1600, height: 1200, focalLength: [1400, 1400])
    let points = (0..<300).map { _ in
      (2 + 6 * random.uniform())
        * SIMD3(random.uniform() - 0.5, random.uniform() - 0.5, 1).normalized
    }
    let turns = [0, 0.12, 0.25].map { angle in
      RigidTransform(
        rotation: Quaternion(x: 0, y: sin(angle / 2), z: 0, w: cos(angle / 2)), translation: .zero)
    }
    let features = turns.map { turn in
      FeatureSet(
        positions: points.map { point in
          let noise = 0.4 * SIMD2(random.normal(), random.normal())
          return SIMD2<Float>(camera.project(turn * point) + noise)
        }, scales: [], orientations: [], descriptors: [], colors: [])
    }
    let pairs = [(0, 1), (0, 2), (1, 2)].map { first, second in
      VerifiedPair(
        pair: PhotoPair(ID(first), ID(second)), model: .homography, secondFromFirst: nil,
        matches: points.indices.map { FeatureMatch(first: Int32($0), second: Int32($0)) },
        medianAngle: 0)
    }
    let photos = turns.indices.map { index in
      Photo(
        id: ID(index), sampleID: index, name: "\(index).jpg", url: URL(fileURLWithPath: "/"),
        width: camera.width, height: camera.height, orientation: 1, camera: ID<Camera>(0))
    }
    var guess = camera
    guess.focalLength *= focalFactor
    #expect(
      PureRotationCheck().isPureRotation(
        ViewGraph(photoCount: 3, pairs: pairs), features: features, photos: photos,
        cameras: [guess]))
  }
}
