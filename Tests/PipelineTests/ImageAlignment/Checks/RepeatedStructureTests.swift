import SceneModel
import Testing

@testable import Pipeline

/// Two instances of a pattern of 30 points, side by side, or an object in two places.
@Suite struct RepeatedStructureTests {
  private let count = 30

  /// Photos 0 and 1 show the first instance, photos 2 and 3 the second one; photo 4 shows both if
  /// `areSimultaneous`. Feature `n` of each photo is point `n` of the instance.
  private func map(areSimultaneous: Bool) -> (Reconstruction, [FeatureSet]) {
    var map = Reconstruction(
      cameras: [], photos: [], poses: (0..<5).map { _ in .identity }, points: [])
    for instance in 0..<2 {
      for number in 0..<count {
        var track = [2 * instance, 2 * instance + 1].map {
          Observation(photo: ID($0), feature: Int32(number), pixel: .zero)
        }
        if areSimultaneous {
          track.append(
            Observation(photo: ID(4), feature: Int32(instance * count + number), pixel: .zero))
        }
        map.points.append(ScenePoint(position: .zero, track: track))
      }
    }
    let features = [count, count, count, count, 2 * count].map {
      FeatureSet(positions: Array(repeating: .zero, count: $0))
    }
    return (map, features)
  }

  private func matches(_ count: Int) -> [FeatureMatch] {
    (0..<count).map { FeatureMatch(first: Int32($0), second: Int32($0)) }
  }

  @Test func instancesThatOnePhotoShowsAreDifferent() {
    let (map, features) = map(areSimultaneous: true)
    let structure = RepeatedStructure(map, features: features)
    #expect(structure.explains(matches(count), of: PhotoPair(ID(0), ID(2))))
    #expect(!structure.explains(matches(8), of: PhotoPair(ID(0), ID(2))))
  }

  /// Nothing proves that what photos 0 and 2 match is not the same: an object that was moved, or
  /// superimposed parts of a scene.
  @Test func instancesThatNoPhotoShowsTogetherMayBeOne() {
    let (map, features) = map(areSimultaneous: false)
    let structure = RepeatedStructure(map, features: features)
    #expect(!structure.explains(matches(count), of: PhotoPair(ID(0), ID(2))))
  }

  @Test func matchesOfOnePointAreNoRepetition() {
    let (map, features) = map(areSimultaneous: true)
    let structure = RepeatedStructure(map, features: features)
    #expect(!structure.explains(matches(count), of: PhotoPair(ID(0), ID(1))))
  }
}
