import SceneModel
import Testing

@testable import Pipeline

/// Whether a plane is what an object stands on or one of its faces.
@Suite struct SupportPlaneDetectionTests {
  private let detection = SupportPlaneDetection()

  @Test(arguments: [0, 0.3]) func plateSurroundsAColumn(tilt: Double) throws {
    var samples = SurfaceSamples(tilt: tilt)
    samples.addLevel(radius: 1) { x, z in x * x + z * z > 0.04 }
    samples.addWall(radius: 0.2, from: 0, to: 0.8)
    let division = try divide(samples)
    #expect(detection.surrounds(samples.plane, division))
    #expect(!detection.hasSideFaces(division))
  }

  @Test(arguments: [0, 0.3]) func samplesAreDivided(tilt: Double) throws {
    var samples = SurfaceSamples(tilt: tilt)
    samples.addLevel(radius: 1) { x, z in x * x + z * z > 0.04 }
    let plate = samples.positions.count
    samples.addWall(radius: 0.2, from: 0, to: 0.8)
    let column = samples.positions.count - plate
    samples.addWall(radius: 1, from: -0.4, to: 0)
    let rim = samples.positions.count - plate - column
    // Within two spacings of the plane, a wall is neither above nor below, nor level.
    let division = try divide(samples)
    #expect(division.level.count == plate)
    #expect(division.above.count * 40 == column * 38)
    #expect(division.below.count * 20 == rim * 18)
    // Without normals, it is level.
    samples.normals = []
    let rough = try divide(samples)
    #expect(rough.above.count == division.above.count)
    #expect(rough.below.count == division.below.count)
    #expect(rough.level.count + rough.above.count + rough.below.count == samples.positions.count)
  }

  @Test func thinRimIsNoSideFace() throws {
    var samples = SurfaceSamples()
    samples.addLevel(radius: 1) { x, z in x * x + z * z > 0.04 }
    samples.addWall(radius: 0.2, from: 0, to: 0.8)
    samples.addWall(radius: 1, from: -0.1, to: 0)
    let division = try divide(samples)
    #expect(!division.below.isEmpty && !detection.hasSideFaces(division))
  }

  @Test func visibleSidesOfAPlinthAreSideFaces() throws {
    var samples = SurfaceSamples()
    samples.addLevel(radius: 0.4) { x, z in x * x + z * z > 0.04 }
    samples.addWall(radius: 0.2, from: 0, to: 0.8)
    let fromAbove = try divide(samples)
    #expect(!detection.hasSideFaces(fromAbove))
    samples.addWall(radius: 0.4, from: -0.8, to: 0)
    let fromAside = try divide(samples)
    #expect(detection.hasSideFaces(fromAside))
  }

  @Test func planeOnOneSideDoesNotSurround() throws {
    var samples = SurfaceSamples()
    samples.addLevel(radius: 1) { x, _ in x > 0.3 }
    samples.addWall(radius: 0.2, from: 0, to: 0.8)
    let division = try divide(samples)
    #expect(!division.level.isEmpty && !division.above.isEmpty)
    #expect(!detection.surrounds(samples.plane, division))
  }

  @Test func barePlateSurroundsNothing() throws {
    var samples = SurfaceSamples()
    samples.addLevel(radius: 1) { _, _ in true }
    let division = try divide(samples)
    #expect(!detection.surrounds(samples.plane, division))
  }

  private func divide(_ samples: SurfaceSamples) throws -> SupportPlaneDetection.Division {
    let reconstruction = IsolationScene().reconstruction()
    let depths = [Double?](repeating: 3, count: reconstruction.poses.count)
    let focus = try #require(ViewFocus(reconstruction, depths: depths))
    return detection.divide(
      samples.positions, samples.normals, by: samples.plane, focus: focus,
      cell: SurfaceSamples.spacing)
  }
}

/// Evenly spaced samples of a plane through the origin and of walls perpendicular to it.
private struct SurfaceSamples {
  static let spacing = 0.02

  /// Rotates all samples about the z axis, in radians.
  var tilt = 0.0
  var positions: [SIMD3<Float>] = []
  var normals: [SIMD3<Float>] = []

  var plane: SupportPlane {
    SupportPlane(normal: rotation * SIMD3<Double>(0, 1, 0), offset: 0, band: Self.spacing)
  }

  private var rotation: Quaternion { Quaternion(angle: tilt, axis: [0, 0, 1]) }

  /// Adds the part that `keeps` selects of a disc around the origin.
  mutating func addLevel(radius: Double, keeps: (Double, Double) -> Bool) {
    let steps = Int((radius / Self.spacing).rounded())
    for i in -steps...steps {
      for j in -steps...steps where i * i + j * j <= steps * steps {
        let (x, z) = (Self.spacing * Double(i), Self.spacing * Double(j))
        if keeps(x, z) { add([x, 0, z], normal: [0, 1, 0]) }
      }
    }
  }

  /// Adds a tube around the y axis between two heights.
  mutating func addWall(radius: Double, from low: Double, to high: Double) {
    let rows = Int(((high - low) / Self.spacing).rounded())
    let columns = Int((2 * .pi * radius / Self.spacing).rounded())
    for row in 0..<rows {
      for column in 0..<columns {
        let turn = Quaternion(
          angle: 2 * .pi * Double(column) / Double(columns), axis: [0, 1, 0])
        let normal = turn * SIMD3<Double>(1, 0, 0)
        let height = low + Self.spacing * (Double(row) + 0.5)
        add(radius * normal + SIMD3<Double>(0, height, 0), normal: normal)
      }
    }
  }

  private mutating func add(_ position: SIMD3<Double>, normal: SIMD3<Double>) {
    positions.append(SIMD3<Float>(rotation * position))
    normals.append(SIMD3<Float>(rotation * normal))
  }
}
