import SceneModel
import Testing

@Suite struct PointCloudTests {
  private func cloud(_ tracks: [[UInt16]], offset: Float = 0) -> PointCloud {
    var cloud = PointCloud()
    for (index, track) in tracks.enumerated() {
      let value = Float(index) + offset
      cloud.positions.append([value, 0, 0])
      cloud.normals.append([0, 0, value])
      cloud.colors.append([UInt8(value), 1, 2])
      cloud.consistency.append(value / 10)
      cloud.footprints.append(value / 100)
      cloud.photoIndices += track
      cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
    }
    return cloud
  }

  @Test func photosAreSlices() {
    let cloud = cloud([[1, 2], [], [0]])
    #expect(cloud.count == 3)
    #expect((0..<3).map { Array(cloud.visiblePhotos(of: $0)) } == [[1, 2], [], [0]])
    #expect(PointCloud().count == 0 && PointCloud().photoOffsets == [0])
  }

  @Test func appendedCloudsKeepTheirPhotos() {
    var all = cloud([[1, 2], [3]])
    all.append(cloud([[4], [], [5, 6]], offset: 10))
    #expect(all.positions.map(\.x) == [0, 1, 10, 11, 12])
    #expect((0..<5).map { Array(all.visiblePhotos(of: $0)) } == [[1, 2], [3], [4], [], [5, 6]])
    #expect(all.colors.map(\.x) == [0, 1, 10, 11, 12] && all.normals[4] == [0, 0, 12])
    #expect(all.consistency.count == 5 && all.footprints[2] == 0.1)
    all.append(PointCloud())
    #expect(all.count == 5 && all.photoOffsets.count == 6)
  }

  @Test func filteredCloudsKeepOrderAndPhotos() {
    let all = cloud([[1, 2], [3], [4, 5], []])
    let some = all.filtered(by: [true, false, true, true])
    #expect(some.positions.map(\.x) == [0, 2, 3] && some.footprints == [0, 0.02, 0.03])
    #expect((0..<3).map { Array(some.visiblePhotos(of: $0)) } == [[1, 2], [4, 5], []])
    #expect(all.filtered(by: [false, false, false, false]).photoOffsets == [0])
  }

  @Test(arguments: [
    [true, false, true, true], [false, false, false, true], [true, true, true, true],
    [false, false, false, false],
  ])
  func retainingIsFilteringInPlace(_ isKept: [Bool]) {
    let all = cloud([[1, 2], [3], [4, 5], []])
    let filtered = all.filtered(by: isKept)
    var retained = all
    retained.retain(isKept)
    #expect(retained.positions == filtered.positions && retained.normals == filtered.normals)
    #expect(retained.colors == filtered.colors && retained.footprints == filtered.footprints)
    #expect(retained.consistency == filtered.consistency)
    #expect(retained.photoOffsets == filtered.photoOffsets)
    #expect(retained.photoIndices == filtered.photoIndices)
  }

  @Test func missingAttributesStayMissing() {
    let bare = PointCloud(positions: [[1, 0, 0], [2, 0, 0]], photoOffsets: [0, 0, 0])
    let some = bare.filtered(by: [false, true])
    #expect(some.positions == [[2, 0, 0]] && some.normals.isEmpty && some.colors.isEmpty)
    #expect(some.consistency.isEmpty && some.footprints.isEmpty)
    var retained = bare
    retained.retain([false, true])
    #expect(retained.positions == [[2, 0, 0]] && retained.normals.isEmpty)
  }
}
