import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

/// The rendered captures that evaluations rely on.
@Suite struct CaptureSceneTests {
  private static func tiny(
    _ object: CaptureObject, _ capture: Capture, photoCount: Int = 4
  ) -> CaptureScene {
    CaptureScene(
      object, capture, .textured, seed: 3, width: 80, photoCount: photoCount, fineness: 0.1)
  }

  @Test func onlyTheObjectMovesOnATurntable() throws {
    let capture = Self.tiny(.box, .turntable)
    #expect(capture.views[0].cameraFromRoom == capture.views[1].cameraFromRoom)
    let scenes = [0, 1].map { capture.scene(ofPhoto: $0) }
    let photos = try [0, 1].map { try scenes[$0].photo($0) }
    let masks = [0, 1].map { scenes[$0].mask($0) }
    func share(_ isIncluded: (Int) -> Bool) -> Double {
      let pixels = masks[0].pixels.indices.filter(isIncluded)
      let differing = pixels.filter { pixel in
        (3 * pixel..<3 * pixel + 3).contains {
          abs(Int(photos[0].pixels[$0]) - Int(photos[1].pixels[$0])) > 12
        }
      }
      return Double(differing.count) / Double(max(1, pixels.count))
    }
    // The rest is the plate, and the edges of the object and its shadow.
    #expect(share { masks[0].pixels[$0] == 0 && masks[1].pixels[$0] == 0 } < 0.15)
    #expect(share { masks[0].pixels[$0] > 0 && masks[1].pixels[$0] > 0 } > 0.5)
    // Noise is part of each photo.
    #expect(photos[0].pixels.prefix(240) != photos[1].pixels.prefix(240))
  }

  @Test(arguments: Capture.allCases, CaptureObject.allCases)
  func camerasProjectTheObjectIntoItsMask(_ kind: Capture, _ object: CaptureObject) {
    let capture = Self.tiny(object, kind)
    for index in [1, 3] { #expect(capture.shareOutsideOfMask(ofPhoto: index) < 0.01) }
  }

  @Test(arguments: Capture.allCases, CaptureObject.allCases)
  func objectsAreInsideOfTheFrame(_ kind: Capture, _ object: CaptureObject) {
    for seed in UInt64(1)...4 {
      let capture = CaptureScene(object, kind, .plain, seed: seed, fineness: 0.1)
      #expect(capture.smallestMargin > 15)
    }
  }

  @Test func theObjectRestsOnTheTable() {
    for kind in [Capture.walk, .hand, .flip] {
      let capture = Self.tiny(.statue, kind)
      for view in capture.views {
        let moved = capture.mesh.moved(by: view.roomFromObject)
        #expect(abs(moved.positions.map(\.y).min() ?? 1) < 1e-5)
      }
    }
  }
}
