import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

/// The rendered photos of a black object on a grained table.
@Suite struct LoudspeakerSceneTests {
  private static func tiny(_ motion: LoudspeakerMotion, seed: UInt64 = 3) -> CaptureScene {
    CaptureScene.loudspeaker(motion, seed: seed, width: 120, fineness: 0.2)
  }

  @Test(arguments: LoudspeakerMotion.allCases)
  func camerasProjectTheObjectIntoItsMask(_ motion: LoudspeakerMotion) {
    let capture = Self.tiny(motion)
    for index in [1, 15] { #expect(capture.shareOutsideOfMask(ofPhoto: index) < 0.01) }
  }

  @Test(arguments: LoudspeakerMotion.allCases)
  func theObjectIsInsideOfTheFrame(_ motion: LoudspeakerMotion) {
    for seed in UInt64(1)...4 {
      #expect(Self.tiny(motion, seed: seed).smallestMargin > 120 * 0.015)
    }
  }

  @Test(arguments: LoudspeakerMotion.allCases)
  func allSidesAreShown(_ motion: LoudspeakerMotion) {
    for seed in UInt64(1)...4 {
      let bearings = Self.tiny(motion, seed: seed).views.map { view in
        let center = view.cameraFromObject.center
        return atan2(center.x, center.z)
      }.sorted()
      let gaps = zip(bearings, bearings.dropFirst() + [bearings[0] + 2 * .pi]).map { $1 - $0 }
      #expect(bearings.count == 24)
      #expect(gaps.max() ?? 7 < 30 * .pi / 180)
    }
  }

  @Test func onlyTheObjectIsTurnedByHand() {
    let capture = Self.tiny(.hand)
    let first = capture.views[0].cameraFromRoom
    let centers = capture.views.map(\.cameraFromRoom.center)
    let middle = centers.reduce(.zero, +) / Double(centers.count)
    let sway = centers.map { ($0 - middle).length }.reduce(0, +) / Double(centers.count)
    #expect(sway > 0.005 && sway < 0.02)
    for view in capture.views {
      #expect((view.cameraFromRoom.rotation * first.rotation.conjugate).angle < 5 * .pi / 180)
      let moved = capture.mesh.moved(by: view.roomFromObject)
      #expect(abs(moved.positions.map(\.y).min() ?? 1) < 1e-5)
    }
  }

  @Test func onlyTheCameraMovesAroundAnObjectThatStandsStill() {
    let capture = Self.tiny(.still)
    #expect(Set(capture.views.map(\.roomFromObject.translation)).count == 1)
    #expect(Set(capture.views.map(\.cameraFromRoom.translation)).count == 24)
  }

  @Test func theObjectIsDarkAndTheTableHasContrast() throws {
    let scene = CaptureScene.loudspeaker(.still, seed: 3, width: 480, fineness: 0.2)
      .scene(ofPhoto: 0)
    let (photo, mask) = (try scene.photo(0), scene.mask(0))
    func values(_ isIncluded: (Int) -> Bool) -> [Double] {
      mask.pixels.indices.filter(isIncluded).map { Double(photo.pixels[3 * $0 + 1]) }.sorted()
    }
    let object = values { mask.pixels[$0] > 0 }
    #expect(object[object.count / 2] > 20)
    #expect(object[object.count / 2] < 60)
    // The lower fifth of the photo shows the table.
    let table = values { mask.pixels[$0] == 0 && $0 > mask.pixels.count * 4 / 5 }
    #expect(table[table.count * 9 / 10] - table[table.count / 10] > 40)
  }

  @Test func theSeedDeterminesThePhotos() throws {
    func photo(_ seed: UInt64) throws -> RasterImage {
      try CaptureScene.loudspeaker(.hand, seed: seed, width: 60, fineness: 0.1)
        .scene(ofPhoto: 2).photo(2)
    }
    #expect(try photo(1).pixels == photo(1).pixels)
    #expect(try photo(1).pixels != photo(2).pixels)
  }
}
