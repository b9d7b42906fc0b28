import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct WhiteningTests {
  /// WᵀW is the inverse of the covariance, in units of the deviation.
  @Test func squareIsTheInverseOfTheCovariance() {
    let c = SIMD3(0.09, -0.02, 0.01)
    let w = Whitening(covariance: c, deviation: 0.1)
    let square = SIMD3(w.xx * w.xx, w.xx * w.xy, w.xy * w.xy + w.yy * w.yy)
    let inverse = 0.01 * SIMD3(c.z, -c.y, c.x) / (c.x * c.z - c.y * c.y)
    for axis in 0..<3 { #expect(abs(square[axis] - inverse[axis]) < 1e-9) }
    #expect(Whitening(covariance: [0.04, 0, 0.04], deviation: 0.2) == .identity)
  }

  /// Half of the observations are uncertain along one direction, such as those of features on an
  /// edge. That they are improves the poses.
  @Test func uncertainDirectionsCountLess() throws {
    let scene = SyntheticScene()
    var errors: [Double] = []
    for isKnown in [false, true] {
      var random = SeededGenerator(seed: 4)
      let observations = scene.reconstruction.points.enumerated().flatMap { index, point in
        point.track.map { observation in
          let angle = 2 * Double.pi * random.uniform()
          let axis = SIMD2(cos(angle), sin(angle))
          let along = index % 2 == 0 ? 1.5 : 0.1
          let noise =
            along * random.normal3().x * axis
            + 0.1 * random.normal3().x * SIMD2(-axis.y, axis.x)
          let spread = along * along - 0.01
          let covariance = SIMD3(
            spread * axis.x * axis.x + 0.01, spread * axis.x * axis.y,
            spread * axis.y * axis.y + 0.01)
          return PointObservation(
            photo: observation.photo.rawValue, point: Int32(index),
            pixel: observation.pixel + noise,
            whitening: isKnown ? Whitening(covariance: covariance, deviation: 0.1) : .identity)
        }
      }
      var problem = BundleAdjustment.Problem(
        photos: PosedPhotos(
          cameras: [scene.camera], poses: scene.poses, cameraOfPhoto: scene.poses.map { _ in 0 }),
        points: scene.reconstruction.points.map(\.position), observations: observations)
      problem.poseFreedom[0] = .constant
      problem.poseFreedom[3] = .scaleFixed
      try BundleAdjustment().run(&problem)
      errors.append(
        PoseComparison(estimated: problem.photos.poses, true: scene.poses).maximumCenterError)
    }
    #expect(errors[1] < 0.5 * errors[0])
  }
}
