import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct SparseMapTests {
  /// More tracks than a unit of parallel work; each is seen in two or three of four photos.
  private static let trackCount = 2 * SparseMap.tracksPerUnit + 100

  private let map: SparseMap = {
    var tracks = FeatureTracks(photoCount: 4)
    for track in 0..<trackCount {
      tracks.append(
        (0..<2 + track % 2).map { photo in
          (Int32(photo), Int32(track), SIMD2(Double(track), Double(photo)))
        })
    }
    var map = SparseMap(cameras: [], photos: [], tracks: tracks)
    map.photos.poses = Array(repeating: RigidTransform.identity, count: 4)
    return map
  }()

  @Test(arguments: [1, 2, 5]) func observationsOfManyTracksAreInTheirOrder(threads: Int) throws {
    let control = KernelControl(threadCount: threads)
    let chosen = (0..<Self.trackCount).filter { $0 % 3 != 0 }
    let (batch, indices) = try map.observations(of: chosen, control) { map, index in
      map.tracks.photos[index] == 1
    }
    #expect(batch.count == chosen.count)
    var expected: [Int] = []
    for (point, track) in chosen.enumerated() {
      let own = map.tracks.observations(of: track).filter { map.tracks.photos[$0] != 1 }
      #expect(batch.range(point) == expected.count..<expected.count + own.count)
      expected += own
    }
    #expect(indices == expected)
    #expect(batch.observations.map(\.pixel) == expected.map { map.tracks.pixels[$0] })
    for point in chosen.indices {
      #expect(batch.observations[batch.range(point)].allSatisfy { $0.point == Int32(point) })
    }
  }

  @Test func addedObservationsReplaceThoseOfTheirPhoto() throws {
    var changed = map
    let last = Self.trackCount - 1
    func addition(_ track: Int, _ photo: Int) -> SparseMap.NewObservation {
      .init(track: track, photo: photo, pixel: [-1, -2], whitening: .identity)
    }
    try changed.add([addition(last, 3), addition(0, 1), addition(last, 0)], KernelControl())
    func photos(_ track: Int) -> [Int32] {
      changed.tracks.observations(of: track).map { changed.tracks.photos[$0] }
    }
    func isNew(_ track: Int) -> [Bool] {
      changed.tracks.observations(of: track).map {
        changed.tracks.features[$0] == SparseMap.noFeature && changed.isActive[$0]
          && changed.tracks.pixels[$0] == [-1, -2]
      }
    }
    #expect(photos(0) == [0, 1] && isNew(0) == [false, true])
    #expect(photos(1) == [0, 1, 2] && isNew(1) == [false, false, false])
    #expect(photos(last) == [0, 1, 2, 3] && isNew(last) == [true, false, false, true])
    #expect(changed.tracks.count == Self.trackCount)
  }
}
