import Foundation
import RealityKit
import Testing

@testable import RealityFoundation
@testable import SharedCommands

@Suite struct PosesFileTests {
  @Test func posesAreSortedByPhoto() throws {
    let photos = [2: "b.jpg", 0: "a.jpg"].mapValues { URL(fileURLWithPath: "/photos/" + $0) }
    let poses = PhotogrammetrySession.Poses(
      posesBySample: [
        2: .init(
          translation: [1, 2, 3], rotation: .init(ix: 0, iy: 0, iz: 0, r: 1), intrinsics: nil,
          lensDistortionData: nil),
        0: .init(
          translation: [4, 5, 6], rotation: .init(ix: 1, iy: 0, iz: 0, r: 0), intrinsics: nil,
          lensDistortionData: nil),
      ], urlsBySample: photos)
    let file = PosesFile(poses) { pose in
      pose.translation.x == 1
        ? .init(focalLength: [900, 901], principalPoint: [400, 300]) : nil
    }
    let object = try JSONSerialization.jsonObject(with: file.encoded()) as? [String: Any]
    let entries = try #require(object?["photos"] as? [[String: Any]])
    #expect(entries.compactMap { $0["name"] as? String } == ["a.jpg", "b.jpg"])
    #expect(entries.compactMap { $0["id"] as? Int } == [0, 2])
    #expect(entries[0]["rotation"] as? [Float] == [1, 0, 0, 0])
    #expect(entries[1]["translation"] as? [Float] == [1, 2, 3])
    #expect(entries[0]["intrinsics"] == nil)
    let intrinsics = entries[1]["intrinsics"] as? [String: [Double]]
    #expect(intrinsics == ["focalLength": [900, 901], "principalPoint": [400, 300]])
    #expect((object?["convention"] as? String)?.hasPrefix("camera to world") == true)
  }
}
