import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

/// Photos of a unit sphere, and perturbed meshes of it.
@Suite struct SurfaceRefinementTests {
  private static let textured = SphereScene(viewCount: 40) { p in
    let waves: [SIMD3<Float>] = [
      [31, 7, -5], [-9, 27, 13], [5, -11, 35], [43, 29, 3], [-17, 39, -33], [21, -37, 41],
      [13, 17, 19],
    ]
    let sum = waves.reduce(Float(0)) { $0 + sin($1.dot(p) + $1.x) }
    return SIMD3(repeating: 128 + 22 * sum)
  }
  private static let plain = SphereScene(viewCount: 40) { _ in SIMD3(repeating: 120) }

  /// A sphere with waves about one pixel high.
  private var wavy: Mesh {
    var mesh = SyntheticMesh.sphere(subdivisions: 6)
    for index in mesh.positions.indices {
      let p = mesh.positions[index]
      let height: Float = sin(9 * p.x + 1) * cos(8 * p.y)
      mesh.positions[index] = p * (1 + 0.01 * height)
    }
    return mesh
  }

  private func refined(
    _ mesh: Mesh, by scene: SphereScene, threads: Int = 2,
    isUsed: (PinholeView) -> Bool = { _ in true },
    mask: RasterImage? = nil
  ) throws -> (mesh: Mesh, moved: Int) {
    let control = KernelControl(threadCount: threads)
    let refinement = try SurfaceRefinement(mesh, control)
    for photo in scene.reconstruction.registered {
      guard let pose = scene.reconstruction.poses[photo.index] else { continue }
      let view = PinholeView(
        photo: photo, image: scene.images[photo.index],
        camera: scene.reconstruction.camera(of: photo), cameraFromWorld: pose, mask: mask)
      if isUsed(view) { try refinement.add(view, control) }
    }
    return try refinement.run(control)
  }

  private func error(_ mesh: Mesh) -> Float {
    mesh.positions.reduce(0) { $0 + abs($1.length - 1) } / Float(mesh.positions.count)
  }

  @Test(.endToEnd) func photosDetermineTheShape() throws {
    let start = wavy
    let (mesh, moved) = try refined(start, by: Self.textured)
    #expect(error(mesh) < 0.5 * error(start))
    #expect(moved > start.positions.count * 9 / 10)
    #expect(mesh.triangles == start.triangles)
  }

  @Test(.endToEnd) func threadCountDoesNotMatter() throws {
    let one = try refined(wavy, by: Self.textured, threads: 1)
    let three = try refined(wavy, by: Self.textured, threads: 3)
    #expect(one.mesh.positions == three.mesh.positions)
    #expect(one.moved == three.moved)
  }

  @Test(.endToEnd) func untexturedSurfaceDoesNotMove() throws {
    let (mesh, moved) = try refined(wavy, by: Self.plain)
    #expect(mesh.positions == wavy.positions)
    #expect(moved == 0)
  }

  @Test func unseenVerticesDoNotMove() throws {
    let start = wavy
    let (mesh, moved) = try refined(
      start, by: Self.textured, isUsed: { $0.cameraFromWorld.center.y > 1 })
    // The lowest camera, at a height of 1, sees points down to a height of −0.96.
    let unseen = start.positions.indices.filter { start.positions[$0].y < -0.97 }
    #expect(unseen.count > 50)
    #expect(unseen.allSatisfy { mesh.positions[$0] == start.positions[$0] })
    #expect(moved > start.positions.count / 4)
  }

  @Test func maskedPixelsAreNotCompared() throws {
    let size = Self.textured.images[0].width
    let mask = RasterImage(width: size, height: size, channels: 1, filledWith: 0)
    let (mesh, moved) = try refined(wavy, by: Self.textured, mask: mask)
    #expect(mesh.positions == wavy.positions)
    #expect(moved == 0)
  }

  @Test(.endToEnd) func boundariesDoNotMove() throws {
    var start = wavy
    start.triangles.removeAll { t in
      [t.a, t.b, t.c].contains { start.positions[Int($0)].y > 0.5 }
    }
    var uses: [Int: Int] = [:]
    for t in start.triangles {
      for (a, b) in [(t.a, t.b), (t.b, t.c), (t.c, t.a)] {
        uses[Int(min(a, b)) << 32 | Int(max(a, b)), default: 0] += 1
      }
    }
    let border = uses.filter { $0.value == 1 }.map { $0.key >> 32 }
    let (mesh, moved) = try refined(start, by: Self.textured)
    #expect(border.count > 50)
    #expect(border.allSatisfy { mesh.positions[$0] == start.positions[$0] })
    #expect(moved > start.positions.count / 3)
  }

  @Test func invalidInputIsRejected() throws {
    var mesh = SyntheticMesh.sphere(subdivisions: 1)
    #expect(throws: KernelError.self) { try SurfaceRefinement(Mesh(), KernelControl()) }
    mesh.positions[0].x = .nan
    #expect(throws: KernelError.self) { try SurfaceRefinement(mesh, KernelControl()) }
    var options = SurfaceRefinement.Options()
    options.radius = 0
    #expect(throws: KernelError.self) {
      try SurfaceRefinement(
        SyntheticMesh.sphere(subdivisions: 1), options: options, KernelControl())
    }
  }
}
