import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct CameraUpTests {
  /// Cameras in a ring around the y axis that look at the origin from a height, each rolled about
  /// its optical axis by quarter turns.
  private func ring(
    count: Int = 24, pitchDegrees: Double, arcDegrees: Double = 360,
    quarterTurns: (Int) -> Int
  ) -> Reconstruction {
    let poses = (0..<count).map { index -> RigidTransform? in
      let angle = arcDegrees * .pi / 180 * Double(index) / Double(count)
      let pitch = pitchDegrees * .pi / 180
      let yaw = Quaternion(angle: angle, axis: [0, 1, 0])
      let tilt = Quaternion(angle: -pitch, axis: [1, 0, 0])
      // Camera axes are x right, y down, z forward.
      let flip = Quaternion(angle: .pi, axis: [1, 0, 0])
      let roll = Quaternion(angle: Double(quarterTurns(index)) * .pi / 2, axis: [0, 0, 1])
      let worldFromCamera = (yaw * tilt * flip * roll).normalized
      let center = worldFromCamera * SIMD3<Double>(0, 0, -1)
      let rotation = worldFromCamera.conjugate
      return RigidTransform(rotation: rotation, translation: -(rotation * center))
    }
    return Reconstruction(cameras: [], photos: [], poses: poses, points: [])
  }

  private func errorDegrees(_ reconstruction: Reconstruction) -> Double {
    let up = CameraUp(reconstruction).direction
    return acos(min(1, max(-1, up.dot([0, 1, 0])))) * 180 / .pi
  }

  @Test(arguments: [0.0, 20, 45, 60])
  func camerasHeldUprightDetermineUp(pitch: Double) {
    #expect(errorDegrees(ring(pitchDegrees: pitch) { _ in 0 }) < 1)
  }

  @Test(arguments: [1, 3])
  func camerasOnTheirSideDetermineUp(turns: Int) {
    #expect(errorDegrees(ring(pitchDegrees: 25) { _ in turns }) < 1)
  }

  /// Landscape, portrait and upside-down photos, without a record of the orientation.
  @Test func mixedOrientationsDetermineUp() {
    let turns = [0, 0, 1, 0, 3, 0, 2, 0]
    #expect(errorDegrees(ring(pitchDegrees: 25) { turns[$0 % turns.count] }) < 1)
  }

  @Test func photosFromOneDirectionStayAsTheyAre() {
    #expect(errorDegrees(ring(pitchDegrees: 0, arcDegrees: 10) { _ in 0 }) < 1)
  }

  @Test func camerasLookingDownHaveTheirBackUp() {
    #expect(errorDegrees(ring(pitchDegrees: 89) { _ in 0 }) < 5)
  }

  /// A ring of level cameras on their side looks the same from above and from below.
  @Test func levelCamerasOnTheirSideLeaveTheSignOpen() {
    #expect(!CameraUp(ring(pitchDegrees: 0) { _ in 1 }).isSignCertain)
    #expect(CameraUp(ring(pitchDegrees: 25) { _ in 1 }).isSignCertain)
    #expect(CameraUp(ring(pitchDegrees: 0) { _ in 0 }).isSignCertain)
  }

  @Test(arguments: ChosenUp.PhotoSide.allCases) func chosenSideIsUp(side: ChosenUp.PhotoSide) {
    let turns = Int((side.angle / (.pi / 2)).rounded())
    let up = CameraUp(ring(pitchDegrees: 20) { _ in -turns }, side: side).direction
    #expect((up - [0, 1, 0]).length < 0.02)
  }

  /// A cone stands on its base.
  @Test(arguments: [1.0, -1]) func objectsStandOnTheirWiderEnd(sign: Double) {
    var random = SeededGenerator(seed: 4)
    let cone = (0..<2000).map { _ -> SIMD3<Double> in
      let (height, angle) = (random.uniform(), 2 * Double.pi * random.uniform())
      return [(1.2 - height) * cos(angle), sign * height, (1.2 - height) * sin(angle)]
    }
    #expect(WiderEndUp().isUpsideDown(cone, up: [0, 1, 0]) == (sign < 0))
    #expect(WiderEndUp().isUpsideDown(cone, up: [0, -1, 0]) == (sign > 0))
  }

  @Test func equalEndsDecideNothing() {
    var random = SeededGenerator(seed: 4)
    let cylinder = (0..<2000).map { _ -> SIMD3<Double> in
      let angle = 2 * Double.pi * random.uniform()
      return [cos(angle), random.uniform(), sin(angle)]
    }
    for up in [1.0, -1] { #expect(!WiderEndUp().isUpsideDown(cylinder, up: [0, up, 0])) }
  }
}
