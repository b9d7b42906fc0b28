import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MissingViewsTests {
  private let compass = Compass(center: .zero, up: [0, 1, 0])
  private let control = KernelControl()

  /// A unit sphere whose triangles at weak bearings are shown by one photo, all others by many.
  private func evidence(
    isWeak: (Compass.Bearing) -> Bool
  ) throws -> ModelEvidence {
    let mesh = SyntheticMesh.sphere(subdivisions: 4)
    let faces = mesh.triangles.map { triangle in
      let bearing = compass.bearing(of: SIMD3<Double>(mesh.center(of: triangle)))
      return ModelEvidence.Face(photoCount: isWeak(bearing) ? 1 : 9)
    }
    return ModelEvidence(
      mesh: mesh, scene: try RayScene(mesh, control), faces: faces,
      painters: [ID<Photo>?](repeating: ID(0), count: faces.count), gains: [:])
  }

  private func run(
    lowest: Double = -90, isWeak: @escaping (Compass.Bearing) -> Bool
  ) throws -> MissingViews.Result {
    try MissingViews().run(
      try evidence(isWeak: isWeak), compass, distance: 3, lowestElevation: lowest, control)
  }

  @Test func nothingIsMissingWhereAllIsShown() throws {
    let result = try run { _ in false }
    #expect(result.weakShare == 0 && result.unreachableShare == 0 && result.places.isEmpty)
  }

  @Test func placesFaceTheWeakPart() throws {
    let middle = Compass.Bearing(azimuth: 100, elevation: 10)
    let result = try run { $0.turn(to: middle) < 35 && abs($0.elevation - 10) < 30 }
    #expect(!result.places.isEmpty && result.unreachableShare == 0)
    for place in result.places {
      #expect(place.bearing.turn(to: middle) < 60)
      #expect(abs(place.bearing.elevation - 10) < 60)
      #expect(abs(place.position.length - 3) < 1e-9)
    }
    // Each needs two more photos.
    #expect(result.places.count >= 2)
    #expect(result.share([result.places[0]]) > 0.8 * result.weakShare)
    #expect(abs(result.share(result.places) - result.weakShare) < 0.02)
  }

  @Test func anUndersideIsOutOfReach() throws {
    let below = try run(lowest: 0) { $0.elevation < -60 }
    // A cap of 30° has (1 − cos 30°) / 2 of the sphere's area.
    #expect(abs(below.weakShare - 0.067) < 0.01)
    #expect(below.places.isEmpty && below.unreachableShare == below.weakShare)
    let free = try run { $0.elevation < -60 }
    #expect(free.unreachableShare == 0 && free.places.allSatisfy { $0.bearing.elevation < -20 })
  }

  /// From below, a weak side and the underside could be seen at once.
  @Test func aSideIsNotTakenForTheUnderside() throws {
    let middle = Compass.Bearing(azimuth: 200, elevation: 0)
    let result = try run(lowest: 0) { $0.elevation < -50 || $0.turn(to: middle) < 50 }
    #expect(!result.places.isEmpty)
    #expect(
      result.places.allSatisfy { $0.bearing.turn(to: middle) < 60 || $0.bearing.elevation > 60 })
    #expect((0.08...0.2).contains(result.unreachableShare))
  }

  @Test func directionsAreEven() {
    let points = MissingViews.evenDirections(200).map { compass.point(at: $0, distance: 1) }
    let nearest = points.indices.map { a in
      points.indices.filter { $0 != a }.map { (points[a] - points[$0]).length }.min() ?? 0
    }
    // The side of a square of a 200th of the sphere is 0.25.
    #expect(nearest.allSatisfy { (0.15...0.3).contains($0) })
    #expect((points.reduce(.zero, +) / 200).length < 0.01)
  }

  @Test func bearingsAndPointsAreInverse() {
    let compass = Compass(center: [1, 2, 3], up: [0.1, 0.9, -0.2])
    for bearing in MissingViews.evenDirections(50) {
      let found = compass.bearing(of: compass.point(at: bearing, distance: 2))
      #expect(found.turn(to: bearing) < 1e-6)
      #expect(abs(found.elevation - bearing.elevation) < 1e-6)
    }
  }
}
