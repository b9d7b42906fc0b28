import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ViewChoiceTests {
  private func views(_ entries: [[FaceObservation]]) throws -> FaceViews {
    try FaceViews(faceCount: 1, observationsByView: entries)
  }

  private func observation(
    area: Float = 100, cosine: Float = 0.9, color: SIMD3<Float> = SIMD3(repeating: 100),
    isClear: Bool = true
  ) -> [FaceObservation] {
    [
      FaceObservation(
        face: 0, area: area, cosine: cosine, gradient: 5, isClear: isClear, color: color)
    ]
  }

  private func rate(_ entries: [[FaceObservation]]) throws -> RatedViews {
    let mesh = Mesh(
      positions: [.zero, [1, 0, 0], [0, 1, 0]], triangles: [Triangle(0, 1, 2)])
    var seen = try views(entries)
    return try ViewCandidates().run(
      draining: &seen, gains: entries.map { _ in .none }, topology: MeshTopology(mesh),
      StageContext())
  }

  /// By block, then by triangle and view.
  private func outliers(_ views: FaceViews, _ mesh: Mesh) throws -> [Bool] {
    try TransientOccluders().run(views, topology: MeshTopology(mesh), StageContext())
      .blocks.flatMap { $0 }
  }

  @Test func frontalLargeAndUnoccludedViewsAreBetter() throws {
    let rated = try rate([
      observation(), observation(cosine: 0.5), observation(area: 50),
      observation(isClear: false),
    ])
    let qualities = rated.views.entries(of: 0).map(\.quality)
    #expect(qualities.count == 4)
    for other in 1..<4 { #expect(qualities[0] > qualities[other]) }
  }

  @Test func outlierColorIsRejected() throws {
    let rated = try rate([
      observation(), observation(color: [102, 99, 101]), observation(color: [180, 100, 100]),
      observation(color: [98, 101, 100]), observation(color: [101, 100, 97]),
    ])
    #expect(rated.views.entries(of: 0).map(\.view) == [0, 1, 3, 4])
    let color = try #require(rated.colors[0])
    #expect((color - SIMD3(repeating: 100)).length < 3)
  }

  @Test func twoDifferingViewsAreBothKept() throws {
    let rated = try rate([observation(), observation(color: [10, 200, 30])])
    #expect(rated.views.entries(of: 0).count == 2)
  }

  @Test func overexposedViewsRankLower() throws {
    let bright = SIMD3<Float>(245, 240, 230)
    var seen = try views([observation(color: bright), observation(color: bright * 0.8)])
    let rated = try ViewCandidates().run(
      draining: &seen,
      gains: [.none, ExposureGain(factors: SIMD3(repeating: 1.22))],
      topology: MeshTopology(Mesh(positions: [], triangles: [])), StageContext())
    let qualities = rated.views.entries(of: 0).map(\.quality)
    #expect(qualities[1] > 2 * qualities[0])
  }

  /// A strip of a grid is hidden by an occluder whose middle has the color of the surface.
  @Test func occluderIsRejectedWithItsBoundaryAndSimilarParts() throws {
    let mesh = SyntheticMesh.grid(cells: 20, origin: .zero, u: [1, 0, 0], v: [0, 1, 0])
    let gray = SIMD3<Float>(repeating: 100)
    let byView = (0..<4).map { view in
      mesh.triangles.enumerated().map { face, triangle in
        let middle = triangle.vertices.reduce(.zero) { $0 + mesh.positions[$1] } / 3
        let distance = abs(middle.x - 0.5)
        let isHidden = view == 1 && distance < 0.2
        // 9 gray levels are within the tolerance.
        let occluder: SIMD3<Float> = distance < 0.1 ? gray + 9 : [180, 60, 60]
        return FaceObservation(
          face: Int32(face), area: 10, cosine: 0.8, gradient: 1,
          color: isHidden ? occluder : gray)
      }
    }
    let views = try FaceViews(faceCount: mesh.triangles.count, observationsByView: byView)
    let isOutlier = try outliers(views, mesh)
    for (entry, isOutlier) in zip(views.blocks.flatMap(\.entries), isOutlier) {
      let triangle = mesh.triangles[Int(entry.face)]
      let middle = triangle.vertices.reduce(.zero) { $0 + mesh.positions[$1] } / 3
      let distance = abs(middle.x - 0.5)
      if entry.view != 1 || distance > 0.3 { #expect(!isOutlier) }
      if entry.view == 1, distance < 0.22 { #expect(isOutlier) }
    }
  }

  /// The same strip; one photo sees its lower end, and two see the part above it.
  @Test func occluderIsFollowedWhereFewPhotosSeeTheSurface() throws {
    let mesh = SyntheticMesh.grid(cells: 20, origin: .zero, u: [1, 0, 0], v: [0, 1, 0])
    func middle(_ face: Int) -> SIMD3<Float> {
      mesh.triangles[face].vertices.reduce(.zero) { $0 + mesh.positions[$1] } / 3
    }
    let byView = (0..<4).map { view in
      mesh.triangles.indices.compactMap { face -> FaceObservation? in
        let p = middle(face)
        if p.y < 0.2, view != 1 { return nil }
        if p.y < 0.4, view > 1 { return nil }
        let isHidden = view == 1 && abs(p.x - 0.5) < 0.2
        return FaceObservation(
          face: Int32(face), area: 10, cosine: 0.8, gradient: 1,
          color: isHidden ? [180, 60, 60] : SIMD3(repeating: 100))
      }
    }
    let views = try FaceViews(faceCount: mesh.triangles.count, observationsByView: byView)
    let isOutlier = try outliers(views, mesh)
    for (entry, isOutlier) in zip(views.blocks.flatMap(\.entries), isOutlier) {
      let distance = abs(middle(Int(entry.face)).x - 0.5)
      if entry.view != 1 || distance > 0.3 { #expect(!isOutlier) }
      if entry.view == 1, distance < 0.2 { #expect(isOutlier) }
    }
    // Next to the occluder, the only view stays.
    let adjacent = zip(views.blocks.flatMap(\.entries), isOutlier).filter {
      middle(Int($0.0.face)).y < 0.2 && abs(middle(Int($0.0.face)).x - 0.5) > 0.2
    }
    #expect(adjacent.allSatisfy { !$0.1 })
  }

  @Test func smallOutliersDoNotSpread() throws {
    let mesh = SyntheticMesh.grid(cells: 20, origin: .zero, u: [1, 0, 0], v: [0, 1, 0])
    let byView = (0..<4).map { view in
      mesh.triangles.indices.map {
        FaceObservation(
          face: Int32($0), area: 10, cosine: 0.8, gradient: 1,
          color: view == 1 && $0 == 400 ? [180, 60, 60] : SIMD3(repeating: 100))
      }
    }
    let views = try FaceViews(faceCount: mesh.triangles.count, observationsByView: byView)
    let isOutlier = try outliers(views, mesh)
    #expect(isOutlier.count { $0 } == 1)
  }

  @Test func exposureGainsAreRecovered() throws {
    // Three photos see 300 triangles; the second is darker, the third has stronger red.
    let truth: [SIMD3<Float>] = [.one, .init(repeating: 0.8), [1.25, 1, 1]]
    var generator = SeededGenerator(seed: 1)
    let colors = (0..<300).map { _ in
      SIMD3<Float>.random(in: 60...180, using: &generator)
    }
    let byView = truth.map { gain in
      colors.enumerated().map { face, color in
        // As exposure affects the values stored in sRGB.
        FaceObservation(
          face: Int32(face), area: 10, cosine: 0.8, gradient: 1,
          color: (color + ExposureGain.encodingOffset) * gain - ExposureGain.encodingOffset)
      }
    }
    let gains = try ExposureCompensation().run(
      try FaceViews(faceCount: 300, observationsByView: byView), viewCount: 3, StageContext())
    for view in 1..<3 {
      let relative = gains[view].factors * truth[view] / (gains[0].factors * truth[0])
      #expect((relative - .one).length < 0.03)
    }
  }

  @Test func pairsOfViewsAreThoseThatSeeTheSameTriangles() throws {
    // Triangle f is seen by views f, f + 1 and f + 70.
    let viewCount = 200
    let byView = (0..<viewCount).map { view in
      [view - 70, view - 1, view].filter { $0 >= 0 && $0 < 130 }.map {
        FaceObservation(face: Int32($0), area: 10, cosine: 0.8, gradient: 1, color: .one)
      }
    }
    let views = try FaceViews(faceCount: 130, observationsByView: byView)
    let pairs = ViewPairs(
      of: stride(from: 0, to: 130, by: 1), in: views, viewCount: viewCount)
    #expect(pairs.viewCount == viewCount && pairs.count == 3 * 130)
    #expect(pairs.partners(of: 100) == [30, 31, 99])
    let all = (0..<viewCount).flatMap { b in pairs.partners(of: b).map { pairs.index(of: b, $0) } }
    #expect(all == Array(0..<pairs.count))
  }

  @Test func cornerWeightsSumToOne() throws {
    let mesh = SyntheticMesh.grid(cells: 6, origin: .zero, u: [1, 0, 0], v: [0, 1, 0])
    let count = mesh.triangles.count
    let byView = (0..<2).map { _ in
      (0..<count).map {
        FaceObservation(face: Int32($0), area: 10, cosine: 0.8, gradient: 1, color: .one)
      }
    }
    var seen = try FaceViews(faceCount: count, observationsByView: byView)
    var rated = try ViewCandidates().run(
      draining: &seen, gains: [.none, .none], topology: MeshTopology(mesh), StageContext())
    let labels = (0..<count).map { $0 == 0 ? Int32(-1) : Int32($0 * 2 / count) }
    let before = rated.views.blocks.reduce(0) { $0 + $1.entries.count }
    let weights = try ViewBlending().run(
      rated, labels: labels, mesh: mesh, topology: MeshTopology(mesh), StageContext())
    for corner in 0..<3 * count {
      let shares = weights.shares(of: corner)
      #expect(abs(shares.reduce(0) { $0 + $1.weight } - 1) < 1e-5)
      #expect(shares.allSatisfy { ($0.view == -1) == (corner < 3) })
    }
    #expect((0..<3 * count).contains { weights.shares(of: $0).count == 2 })
    // The views that it doesn't use can be removed.
    try ViewBlending().restrict(
      &rated, labels: labels, mesh: mesh, topology: MeshTopology(mesh), KernelControl())
    let restricted = try ViewBlending().run(
      rated, labels: labels, mesh: mesh, topology: MeshTopology(mesh), StageContext())
    #expect(restricted.shares == weights.shares && restricted.offsets == weights.offsets)
    #expect(rated.views.blocks.reduce(0) { $0 + $1.entries.count } < before * 3 / 4)
  }

  @Test func topologyEdgesReferenceTheirTriangles() {
    let mesh = SyntheticMesh.cube(cells: 3)
    let topology = MeshTopology(mesh)
    #expect(topology.edges.count == mesh.triangles.count * 3 / 2)
    for edge in topology.edges {
      #expect(edge.second > edge.first)
      for face in [edge.first, edge.second] {
        let vertices = mesh.triangles[Int(face)].vertices
        #expect(vertices.contains(Int(edge.low)) && vertices.contains(Int(edge.high)))
      }
    }
  }
}
