import Foundation
import SceneModel
import Testing

@Suite struct ReconstructionRestrictionTests {
  /// Four photos, of which the last is not registered, and the points that these photos observe.
  private func reconstruction(_ tracks: [[Int]]) -> Reconstruction {
    Reconstruction(
      cameras: [Camera(width: 100, height: 80, focalLength: [90, 90])],
      photos: (0..<4).map { index in
        Photo(
          id: ID(index), sampleID: index, name: "\(index).jpg", url: URL(fileURLWithPath: "/"),
          width: 100, height: 80, orientation: 1, camera: ID(0))
      },
      poses: (0..<4).map { index in
        index == 3
          ? nil : RigidTransform(rotation: .identity, translation: [Double(index), 0, 0])
      },
      points: tracks.enumerated().map { number, track in
        ScenePoint(
          position: [Double(number), 0, 5], color: [UInt8(number), 0, 0],
          track: track.map { Observation(photo: ID($0), feature: Int32(number), pixel: [1, 2]) })
      }, worldFrame: WorldFrame(scale: .gps, up: .gravity))
  }

  @Test func pointsThatTwoPhotosShowRemain() {
    let whole = reconstruction([[0, 1, 2], [0, 1], [1, 2], [0, 2]])
    let part = whole.restricted(to: [2, 0])
    #expect(part.registered == [ID(0), ID(2)])
    #expect(part.poses[0] == whole.poses[0] && part.poses[2] == whole.poses[2])
    #expect(part.points.map(\.position) == [whole.points[0].position, whole.points[3].position])
    #expect(part.points.map { $0.track.map(\.photo.index) } == [[0, 2], [0, 2]])
    #expect(part.points[0].color == whole.points[0].color)
  }

  /// IDs stay valid.
  @Test func photosAndFrameRemain() {
    let whole = reconstruction([[0, 1]])
    let part = whole.restricted(to: [1])
    #expect(part.photos == whole.photos && part.cameras == whole.cameras)
    #expect(part.poses.count == 4 && part.points.isEmpty)
    #expect(part.worldFrame == whole.worldFrame)
  }

  @Test func allPhotosKeepEverything() {
    let whole = reconstruction([[0, 1, 2], [1, 2]])
    let same = whole.restricted(to: [0, 1, 2, 3])
    #expect(same.poses == whole.poses && same.points == whole.points)
  }

  /// As well as photos that are not registered.
  @Test(arguments: [[], [3]]) func noPhotosKeepNothing(group: [Int]) {
    let part = reconstruction([[0, 1], [1, 2]]).restricted(to: group)
    #expect(part.registered.isEmpty && part.points.isEmpty)
  }
}
