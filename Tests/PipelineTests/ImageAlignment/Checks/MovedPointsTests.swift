import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct MovedPointsTests {
  private typealias Comparison = SceneAmbiguityCheck.Comparison

  /// A ring of photos that is taken twice, before and after an object is moved. In the map of the
  /// table, which most points are on, photos of both rings have the same poses.
  private let photoCount = 28

  /// Each photo shows `objectPoints` points of the object, which the next one of its ring shows as
  /// well, and `tablePoints` that are seen all around.
  private func scene(
    objectPoints: Int, tablePoints: Int, contradicting: Range<Int>
  ) -> (comparisons: [Comparison], map: Reconstruction) {
    let half = photoCount / 2
    var map = Reconstruction(
      cameras: [], photos: [], poses: (0..<photoCount).map { _ in .identity }, points: [])
    func addPoint(seenBy photos: [Int]) -> Int32 {
      map.points.append(
        ScenePoint(
          position: .zero,
          track: photos.map { Observation(photo: ID($0), feature: 0, pixel: .zero) }))
      return Int32(map.points.count - 1)
    }
    let object = (0..<photoCount).map { photo in
      (0..<objectPoints).map { _ in
        addPoint(seenBy: (photo + 1) % half == 0 ? [photo] : [photo, photo + 1])
      }
    }
    let table = (0..<tablePoints).map { _ in addPoint(seenBy: Array(0..<photoCount)) }
    let comparisons = (0..<half).map { photo in
      var comparison = Comparison(pair: PhotoPair(ID(photo), ID(photo + half)))
      comparison.present = table
      comparison.absent = object[photo] + object[photo + half]
      if contradicting.contains(photo) { comparison.contradicting = comparison.absent }
      return comparison
    }
    return (comparisons, map)
  }

  /// However little the photos show of the object, and even if not all of them contradict.
  @Test(arguments: [40, 150], [0..<14, 3..<10])
  func smallObjectIsDividedWhereItWasMoved(tablePoints: Int, contradicting: Range<Int>) throws {
    let (comparisons, map) = scene(
      objectPoints: 8, tablePoints: tablePoints, contradicting: contradicting)
    let features = (0..<photoCount).map { _ in FeatureSet(positions: [.zero]) }
    let placements = try PlacementDetection().groups(
      comparisons, map, ViewGraph(photoCount: photoCount, pairs: []),
      RepeatedStructure(map, features: features), neededPoints: 30, KernelControl())
    #expect(placements.groups == [Array(0..<14), Array(14..<28)])
  }

  @Test func pointsThatNothingContradictsAreNotInformative() {
    let (comparisons, map) = scene(objectPoints: 8, tablePoints: 40, contradicting: 0..<0)
    let moved = MovedPoints(comparisons)
    #expect(moved.covisibility(map).isEmpty)
    #expect(comparisons.allSatisfy { moved.count($0.present + $0.absent) == 0 })
  }

  /// A point that more photos show than miss was hidden.
  @Test func hiddenPointsWereNotMoved() {
    var (comparisons, _) = scene(objectPoints: 1, tablePoints: 3, contradicting: 0..<14)
    comparisons[0].absent += comparisons[0].present
    comparisons[0].contradicting = comparisons[0].absent
    #expect(MovedPoints(comparisons).count(comparisons[1].present) == 0)
    #expect(MovedPoints(comparisons).count(comparisons[0].contradicting) == 2)
  }

  /// A point counts once against each boundary between the photos that observe it.
  @Test func covisibilityOfAPointIsAChain() {
    var (comparisons, map) = scene(objectPoints: 1, tablePoints: 0, contradicting: 0..<1)
    map.points[0].track = [9, 2, 5, 5].map {
      Observation(photo: ID($0), feature: 0, pixel: .zero)
    }
    comparisons = [comparisons[0]]
    comparisons[0].contradicting = [0]
    #expect(
      MovedPoints(comparisons).covisibility(map)
        == [PhotoPair(ID(2), ID(5)): 1, PhotoPair(ID(5), ID(9)): 1])
  }
}
