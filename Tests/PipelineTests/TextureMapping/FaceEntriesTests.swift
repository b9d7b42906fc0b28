import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct FaceEntriesTests {
  /// Three blocks, the last incomplete.
  private static let faceCount = 2 * FaceBlocks.size + 100
  private static let viewCount = 6

  /// Random observations of each view, ascending by triangle.
  private func observations(seed: UInt64) -> [[FaceObservation]] {
    var generator = SeededGenerator(seed: seed)
    return (0..<Self.viewCount).map { _ in
      (0..<Self.faceCount).compactMap { face in
        guard Int.random(in: 0..<3, using: &generator) > 0 else { return nil }
        return FaceObservation(
          face: Int32(face), area: Float(Int.random(in: 1...9, using: &generator)), cosine: 0.8,
          gradient: 1, isClear: .random(using: &generator),
          isInterior: .random(using: &generator),
          color: .random(in: 0...255, using: &generator))
      }
    }
  }

  @Test func observationsKeepTheirValues() {
    var observation = FaceObservation(
      face: 7, view: 3, area: 2, cosine: 0.5, gradient: 4, isClear: false, color: [1, 2, 3])
    #expect(observation.view == 3 && !observation.isClear && observation.isInterior)
    observation.view = 1 << 28
    observation.color *= 2
    #expect(observation.view == 1 << 28 && !observation.isClear && observation.isInterior)
    #expect(observation.color == [2, 4, 6])
    #expect(MemoryLayout<FaceObservation>.stride == 32)
  }

  @Test func observationsAreGroupedByTriangle() throws {
    let byView = observations(seed: 1)
    let views = try FaceViews(faceCount: Self.faceCount, observationsByView: byView)
    #expect(views.faceCount == Self.faceCount)
    var expected = [[FaceObservation]](repeating: [], count: Self.faceCount)
    for (view, list) in byView.enumerated() {
      for var observation in list {
        observation.view = Int32(view)
        expected[Int(observation.face)].append(observation)
      }
    }
    for face in 0..<Self.faceCount {
      #expect(Array(views.entries(of: face)) == expected[face])
      for view in 0..<Int32(Self.viewCount) {
        let found = views.index(of: face, in: view).map { views[$0] }
        #expect(found == expected[face].first { $0.view == view })
      }
    }
  }

  /// Of equal areas, those of the first views are kept.
  @Test(arguments: [1, 2, 3, 8]) func theLargestObservationsAreKept(threads: Int) throws {
    let byView = observations(seed: 2)
    let all = try FaceViews(faceCount: Self.faceCount, observationsByView: byView)
    let lists = byView.map { FaceViews.pieces(of: $0, faceCount: Self.faceCount) }
    var pieces = (0..<3).map { block in lists.map { $0[block] } }
    let views = try FaceViews(
      draining: &pieces, faceCount: Self.faceCount, maximumCount: 3,
      KernelControl(threadCount: threads))
    #expect(pieces.isEmpty)
    for face in 0..<Self.faceCount {
      let largest = all.entries(of: face)
        .sorted { ($0.area, $1.view) > ($1.area, $0.view) }.prefix(3)
      #expect(Array(views.entries(of: face)) == largest.sorted { $0.view < $1.view })
    }
  }

  @Test func blocksAreFilteredInPlace() throws {
    var views = try FaceViews(
      faceCount: Self.faceCount, observationsByView: observations(seed: 3))
    let expected = (0..<Self.faceCount).map { views.entries(of: $0).filter { $0.area > 8 } }
    try views.updateBlocks(KernelControl(threadCount: 3)) { _, block in
      block.filter { _, entry in entry.area > 8 }
    }
    for face in 0..<Self.faceCount { #expect(Array(views.entries(of: face)) == expected[face]) }
  }

  /// Candidates and labels of a curved surface with random colors.
  @Test func choicesDoNotDependOnThreads() throws {
    let mesh = SyntheticMesh.grid(cells: 70, origin: .zero, u: [1, 0, 0], v: [0, 1, 0])
    let topology = MeshTopology(mesh)
    let byView = observations(seed: 4).map { $0.filter { $0.face < mesh.triangles.count } }
    let results = try [1, 2, 3, 8].map { threads in
      let context = StageContext(control: KernelControl(threadCount: threads))
      var seen = try FaceViews(faceCount: mesh.triangles.count, observationsByView: byView)
      var rated = try ViewCandidates().run(
        draining: &seen, gains: byView.map { _ in .none }, topology: topology, context)
      let labels = try ViewSelection().run(rated, mesh: mesh, topology: topology, context)
      try ViewBlending().restrict(
        &rated, labels: labels, mesh: mesh, topology: topology, context.control)
      let views = rated.views.blocks.flatMap(\.entries).map { [Float($0.view), $0.quality] }
      return (labels: labels, colors: rated.colors, views: views)
    }
    for result in results.dropFirst() {
      #expect(result.labels == results[0].labels)
      #expect(result.colors == results[0].colors)
      #expect(result.views == results[0].views)
    }
  }
}
