import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct RaySceneTests {
  private func view(distance: Double) -> PinholeView {
    .fromAbove(
      RasterImage(width: 200, height: 200, channels: 3, filledWith: 100), distance: distance)
  }

  @Test func aCameraSeesTheFacingSideOfACube() throws {
    let mesh = SyntheticMesh.cube(cells: 4)
    let scene = try RayScene(mesh, KernelControl())
    let seen = try scene.observations(in: view(distance: 5), KernelControl())
    let front = mesh.triangles.indices.filter { index in
      let t = mesh.triangles[index]
      return [t.a, t.b, t.c].allSatisfy { mesh.positions[Int($0)].z == 1 }
    }
    #expect(seen.map { Int($0.face) } == front)
    #expect(seen.count == 32)
    // The side of 2 at distance 4 has 200 · 2 / 4 = 100 pixels.
    #expect(abs(seen.reduce(0) { $0 + $1.area } - 100 * 100) < 1)
    #expect(seen.allSatisfy { $0.color == SIMD3(repeating: 100) && $0.cosine > 0.9 })
  }

  @Test func occludersHideAndTheirEdgesAreUncertain() throws {
    let wall = SyntheticMesh.grid(cells: 20, origin: [-1, -1, 0], u: [2, 0, 0], v: [0, 2, 0])
    var mesh = wall
    mesh.append(
      SyntheticMesh.grid(cells: 2, origin: [-0.3, -0.3, 1], u: [0.6, 0, 0], v: [0, 0.6, 0]))
    let scene = try RayScene(mesh, KernelControl())
    let seen = try scene.observations(in: view(distance: 4), KernelControl())
    func middle(_ face: Int32) -> SIMD3<Float> {
      let t = mesh.triangles[Int(face)]
      let corners = [t.a, t.b, t.c].map { mesh.positions[Int($0)] }
      return (corners[0] + corners[1] + corners[2]) / 3
    }
    // From 4 above, the square of ±0.3 at height 1 covers ±0.4 of the wall.
    let onWall = seen.filter { middle($0.face).z == 0 }
    for observation in onWall {
      let p = middle(observation.face)
      #expect(max(abs(p.x), abs(p.y)) > 0.39)
      if max(abs(p.x), abs(p.y)) > 0.75 { #expect(observation.isClear) }
    }
    #expect(onWall.contains { !$0.isClear })
    #expect(onWall.count > 400)
  }

  @Test func trianglesOutsideTheImageAreNotSeen() throws {
    let mesh = SyntheticMesh.grid(cells: 20, origin: [-9, -9, 0], u: [18, 0, 0], v: [0, 18, 0])
    let scene = try RayScene(mesh, KernelControl())
    let seen = try scene.observations(in: view(distance: 5), KernelControl())
    // Half the field of view is 2.5, cells are 0.9: two cells each way lie inside.
    #expect(seen.count == 2 * 4 * 4)
  }

  @Test func invalidMeshesAreRejected() {
    #expect(throws: KernelError.self) { try RayScene(Mesh(), KernelControl()) }
    let missing = Mesh(positions: [.zero], triangles: [.init(0, 1, 2)])
    #expect(throws: KernelError.self) { try RayScene(missing, KernelControl()) }
    let infinite = Mesh(
      positions: [.zero, [.infinity, 0, 0], [0, 1, 0]], triangles: [.init(0, 1, 2)])
    #expect(throws: KernelError.self) { try RayScene(infinite, KernelControl()) }
  }

  @Test func raysAreBlockedByWhatIsBetween() throws {
    let scene = try RayScene(SyntheticMesh.sphere(subdivisions: 3), KernelControl())
    let starts: [SIMD3<Float>] = [[0, 0, 3], [0, 0, 3], [0, 3, 3], [0, 0, 1], [0, 0, 1]]
    let ends: [SIMD3<Float>] = [[0, 0, -3], [0, 0, 1.5], [0, 3, -3], [0, 0, 3], [0, 0, -3]]
    #expect(
      try scene.isBlocked(from: starts, to: ends, KernelControl())
        == [true, false, false, false, true])
    #expect(try scene.isBlocked(from: [], to: [], KernelControl()).isEmpty)
    #expect(throws: KernelError.self) {
      try scene.isBlocked(from: [[0, 0, 0]], to: [], KernelControl())
    }
  }
}
