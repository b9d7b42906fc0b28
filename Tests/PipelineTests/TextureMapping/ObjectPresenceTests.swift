import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ObjectPresenceTests {
  /// A triangle at a place that all photos see with an area of `area` pixels.
  private func concerns(at place: SIMD3<Float>, area: Float) throws -> [String] {
    let scene = SyntheticScene().reconstruction
    let mesh = Mesh(
      positions: [place, place + [0.01, 0, 0], place + [0, 0.01, 0]],
      triangles: [Triangle(0, 1, 2)])
    let observation = FaceObservation(
      face: 0, area: area, cosine: 1, gradient: 1, color: SIMD3(repeating: 100))
    let notes = StageNotes()
    let seen = try FaceViews(
      faceCount: 1, observationsByView: scene.registered.map { _ in [observation] })
    ObjectPresence().run(mesh, seen: seen, views: scene.registered, scene, notes)
    return notes.concerns
  }

  private var pixels: Float {
    let camera = SyntheticScene().reconstruction.cameras[0]
    return Float(camera.width * camera.height)
  }

  @Test func aModelInTheMiddleIsNoConcern() throws {
    #expect(try concerns(at: .zero, area: 0.1 * pixels).isEmpty)
  }

  @Test func aSpeckIsAConcern() throws {
    #expect(try concerns(at: .zero, area: 1e-4 * pixels).count == 1)
  }

  @Test func aModelBesideTheMiddleIsAConcern() throws {
    #expect(try concerns(at: [0, 40, 0], area: 0.1 * pixels).count == 1)
  }
}
