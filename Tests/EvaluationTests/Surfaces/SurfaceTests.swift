import SceneModel
import Testing

@testable import Evaluation

@Suite struct SurfaceTests {
  /// A square of side `side` at height z, `cells` × `cells` × 2 triangles.
  static func square(side: Float, z: Float = 0, cells: Int = 8) -> Mesh {
    var mesh = Mesh()
    for row in 0...cells {
      for column in 0...cells {
        mesh.positions.append(
          [side * Float(column) / Float(cells), side * Float(row) / Float(cells), z])
      }
    }
    for row in 0..<cells {
      for column in 0..<cells {
        let a = UInt32(row * (cells + 1) + column)
        let c = a + UInt32(cells + 1)
        mesh.triangles += [Triangle(a, a + 1, c + 1), Triangle(a, c + 1, c)]
      }
    }
    return mesh
  }

  static func append(_ other: Mesh, to mesh: inout Mesh) {
    let first = UInt32(mesh.positions.count)
    mesh.positions += other.positions
    mesh.triangles += other.triangles.map { Triangle($0.a + first, $0.b + first, $0.c + first) }
  }

  static var options: SurfaceComparison.Options {
    var options = SurfaceComparison.Options()
    options.resultSamples = 4000
    options.referenceSamples = 4000
    options.thresholds = [0.1, 0.3]
    options.maximumDistance = 1
    options.margin = 0.5
    return options
  }

  static func compare(
    _ result: Mesh, _ alignment: SimilarityTransform = .identity, with reference: Mesh,
    cameras: [NamedCamera] = [], options: SurfaceComparison.Options = options
  ) throws -> SurfaceScores {
    let comparison = SurfaceComparison(options)
    return try comparison.run(
      result, alignment, reference: comparison.reference(reference, cameras: cameras))
  }

  /// At the default truncation of 2 cm, any distance would be within half a meter.
  @Test(arguments: [(0.4, 1.0), (0.6, 0.0)])
  func largeThresholdsAreNotTruncated(_ distance: Float, _ share: Double) throws {
    var options = SurfaceComparison.Options()
    options.compare(at: [0.5, 0.05])
    (options.resultSamples, options.referenceSamples) = (1000, 1000)
    let scores = try Self.compare(
      Self.square(side: 4, z: distance), with: Self.square(side: 4), options: options)
    #expect(scores.thresholds.map(\.threshold) == [0.05, 0.5])
    #expect(scores.thresholds.map(\.precision) == [0, share])
    #expect(scores.thresholds.map(\.recall) == [0, share])
    #expect(abs(scores.chamfer - Double(distance)) < 1e-6)
  }

  @Test func treeAgreesWithBruteForce() {
    var random = SplitMix64(seed: 3)
    func point(_ range: ClosedRange<Float>) -> SIMD3<Float> {
      .init(
        .random(in: range, using: &random), .random(in: range, using: &random),
        .random(in: range, using: &random))
    }
    let triangles = (0..<300).map { _ in
      let corner = point(-1...1)
      return FlatTriangle(corner, corner + point(-0.2...0.2), corner + point(-0.2...0.2))
    }
    let tree = BoundingTree(triangles)
    var stack = BoundingTree<FlatTriangle>.Stack()
    for _ in 0..<200 {
      let query = point(-2...2)
      let expected = triangles.map { $0.squaredDistance(to: query) }.min() ?? 0
      let found = tree.distance(to: query, limit: 100, &stack)
      #expect(abs(found - expected.squareRoot()) < 1e-6)
    }
    #expect(tree.distance(to: [50, 0, 0], limit: 2, &stack) == 2)
  }

  @Test(arguments: [0, 1, 3, 4, 5, 17]) func smallTreesFindTheNearestPoint(_ count: Int) {
    let points = (0..<count).map { SIMD3<Float>(Float($0), 0, 0) }
    let tree = BoundingTree(points)
    var stack = BoundingTree<SIMD3<Float>>.Stack()
    let expected: Float = count == 0 ? 9 : 1
    #expect(tree.distance(to: [0, 1, 0], limit: 9, &stack) == expected)
  }

  @Test func closestPointsLieInTheTriangle() {
    let t = FlatTriangle([0, 0, 0], [1, 0, 0], [0, 1, 0])
    #expect(t.closestPoint(to: [-1, -1, 5]) == [0, 0, 0])
    #expect(t.closestPoint(to: [3, -1, 0]) == [1, 0, 0])
    #expect(t.closestPoint(to: [-1, 3, 0]) == [0, 1, 0])
    #expect(t.closestPoint(to: [0.5, -1, 1]) == [0.5, 0, 0])
    #expect(t.closestPoint(to: [-2, 0.25, 1]) == [0, 0.25, 0])
    #expect(t.closestPoint(to: [1, 1, 0]) == [0.5, 0.5, 0])
    #expect(t.closestPoint(to: [0.25, 0.25, 7]) == [0.25, 0.25, 0])
    let point = FlatTriangle([1, 1, 1], [1, 1, 1], [1, 1, 1])
    #expect(point.squaredDistance(to: [1, 1, 3]) == 4)
  }

  @Test func samplesAreEvenAndRepeatable() {
    let mesh = Self.square(side: 2)
    let samples = SurfaceSampling().run(mesh, count: 10_000)
    #expect(samples == SurfaceSampling().run(mesh, count: 10_000))
    for quadrant in [(0, 0), (0, 1), (1, 0), (1, 1)] {
      let inside = samples.count { Int($0.x) == quadrant.0 && Int($0.y) == quadrant.1 }
      #expect(abs(inside - 2500) < 60)
    }
    #expect(SurfaceSampling().run(Mesh(), count: 10).isEmpty)
    #expect(SurfaceSampling().run(mesh, count: 0).isEmpty)
  }

  @Test func parallelSquaresAreTheirDistanceApart() throws {
    let scores = try Self.compare(Self.square(side: 1, z: 0.2), with: Self.square(side: 1))
    #expect(abs(scores.chamfer - 0.2) < 1e-5)
    #expect(scores.thresholds.map(\.fScore) == [0, 1])
  }

  @Test func halfOfTheSurfaceIsPreciseButIncomplete() throws {
    let alignment = SimilarityTransform(scale: 0.5, rotation: .identity, translation: .zero)
    var half = Self.square(side: 2)
    half.positions = half.positions.map { [$0.x, $0.y / 2, $0.z] }
    let scores = try Self.compare(half, alignment, with: Self.square(side: 1))
    #expect(scores.thresholds[0].precision == 1)
    #expect(abs(scores.thresholds[0].recall - 0.6) < 0.01)
    #expect(abs(scores.completeness - 0.125) < 0.01)
  }

  @Test func distantPartsAreIgnored() throws {
    var options = Self.options
    options.margin = 0.01
    let table = Self.square(side: 10, cells: 100)
    let scores = try Self.compare(table, with: Self.square(side: 1), options: options)
    #expect(scores.thresholds[0].precision == 1)
    #expect(scores.resultSamples < 100)
  }

  /// A camera that looks down at the middle of the unit square from a height; photos have `side`
  /// pixels per side.
  private static func camera(above height: Double, side: Int) -> NamedCamera {
    NamedCamera(
      name: "a", camera: Camera(width: side, height: side, focalLength: [100, 100]),
      cameraFromWorld: RigidTransform(
        rotation: Quaternion(angle: .pi, axis: [1, 0, 0]), translation: [-0.5, 0.5, height]))
  }

  @Test func invisiblePartsOfTheReferenceAreIgnored() throws {
    var reference = Self.square(side: 1)
    let below = Self.square(side: 1, z: -0.4)
    Self.append(below, to: &reference)
    let camera = Self.camera(above: 5, side: 100)
    var options = Self.options
    options.minimumViews = 1
    let seen = try Self.compare(
      Self.square(side: 1), with: reference, cameras: [camera], options: options)
    #expect(seen.thresholds[0].recall == 1)
    #expect(abs(seen.referenceSamples - 2000) < 20)
    let all = try Self.compare(Self.square(side: 1), with: reference, options: options)
    #expect(abs(all.thresholds[0].recall - 0.5) < 0.01)
  }

  @Test func surfaceSeenAtAGlanceCanBeIgnored() throws {
    // From 0.5 above the middle of a square, a circle of radius 0.5 is seen within 45 degrees.
    let camera = Self.camera(above: 0.5, side: 400)
    var options = Self.options
    options.minimumViews = 1
    let square = Self.square(side: 1)
    func seen() throws -> Int {
      try Self.compare(square, with: square, cameras: [camera], options: options).referenceSamples
    }
    #expect(try seen() == options.referenceSamples)
    options.maximumViewAngleDegrees = 45
    #expect(abs(Double(try seen()) / Double(options.referenceSamples) - .pi / 4) < 0.01)
  }

  @Test func threadsDoNotMatter() throws {
    var options = Self.options
    options.resultSamples = 20_000
    let result = Self.square(side: 1, z: 0.05)
    let reference = Self.square(side: 1)
    let one = try Self.compare(result, with: reference, options: options)
    options.threadCount = 3
    #expect(try Self.compare(result, with: reference, options: options) == one)
  }

  @Test func cloudsAreScoredDirectly() throws {
    let cloud = PointCloud(positions: [[0.5, 0.5, 0.05], [0.25, 0.25, 0.2]])
    let comparison = SurfaceComparison(Self.options)
    let scores = try comparison.run(
      cloud, .identity, reference: comparison.reference(Self.square(side: 1)))
    #expect(scores.resultSamples == 2)
    #expect(scores.thresholds[0].precision == 0.5)
    #expect(scores.thresholds[0].recall < 0.1)
  }

  /// A thousand points on the square and one above it: without downsampling, one in a thousand is
  /// wrong.
  @Test func downsamplingCountsVoxelsInsteadOfPoints() throws {
    let square = Self.square(side: 1)
    var cloud = PointCloud(positions: SurfaceSampling().run(square, count: 1000))
    cloud.positions = cloud.positions.map { [$0.x / 10, $0.y / 10, 0] } + [[0.5, 0.5, 0.4]]
    let comparison = SurfaceComparison(Self.options)
    let reference = try comparison.reference(square)
    let raw = try comparison.run(cloud, .identity, reference: reference)
    #expect(abs(raw.thresholds[0].precision - 0.999) < 1e-4)
    let averaged = try comparison.run(cloud, .identity, reference: reference, voxel: 0.3)
    #expect(averaged.resultSamples == 2)
    #expect(averaged.thresholds[0].precision == 0.5)
  }

  @Test func downsampledPointsAreMeans() {
    let points: [SIMD3<Float>] = [[0, 0, 0], [5, 5, 5], [0.5, 0.25, 0.75], [5.5, 5, 5]]
    let means = VoxelAveraging(side: 1).run(points)
    #expect(means == [[0.25, 0.125, 0.375], [5.25, 5, 5]])
    #expect(VoxelAveraging(side: 1).run([]).isEmpty)
    #expect(VoxelAveraging(side: 1e-30).run([[0, 0, 0], [1, 1, 1]]).count == 2)
  }

  /// A wall of height 1 on the plane z = 0; the lower half is excluded on both sides.
  @Test func partsBelowTheFloorAreIgnored() throws {
    func wall(_ heights: ClosedRange<Float>, y: Float) -> Mesh {
      var mesh = Self.square(side: 1)
      let (low, span) = (heights.lowerBound, heights.upperBound - heights.lowerBound)
      mesh.positions = mesh.positions.map { [$0.x, y, low + span * $0.y] }
      return mesh
    }
    var options = Self.options
    var result = wall(0.5...1, y: 0)
    let wrong = wall(0...0.499, y: 0.4)
    Self.append(wrong, to: &result)
    let all = try Self.compare(result, with: wall(0...1, y: 0), options: options)
    #expect(all.thresholds[0].precision < 0.6)
    #expect(all.thresholds[0].recall < 0.7)
    options.floor = Floor(axis: 2, height: 0.5)
    let above = try Self.compare(result, with: wall(0...1, y: 0), options: options)
    #expect(above.thresholds[0].precision == 1)
    #expect(above.thresholds[0].recall == 1)
  }

  /// The extent of such a surface is not a 32-bit number.
  @Test func distancesOfHugeSurfacesAreFinite() {
    let far = Float.greatestFiniteMagnitude
    let points: [SIMD3<Float>] = [[-far, 0, 0], [far, 1, 0], [0, 0, 1], [.infinity, 0, 0]]
    var stack = BoundingTree<SIMD3<Float>>.Stack()
    let distance = BoundingTree(points).distance(to: [0, 0, 1.5], limit: 1, &stack)
    #expect(distance == 0.5)
  }

  @Test func nothingToCompareIsAnError() {
    #expect(throws: EvaluationError.emptySurface) {
      try Self.compare(Mesh(), with: Self.square(side: 1))
    }
    #expect(throws: EvaluationError.emptySurface) {
      try Self.compare(Self.square(side: 1), with: Mesh())
    }
    #expect(throws: EvaluationError.emptySurface) {
      let comparison = SurfaceComparison(Self.options)
      return try comparison.run(
        PointCloud(), .identity, reference: comparison.reference(Self.square(side: 1)))
    }
  }
}
