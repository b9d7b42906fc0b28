import Foundation
import SceneModel

/// A surface that hides tiles from photos, as one process leaves it for others.
struct OccluderRecord: LargeUnitValue {
  private var positions: Data
  private var triangles: Data

  init(_ mesh: Mesh) {
    positions = Data(bytesOf: mesh.positions)
    triangles = Data(bytesOf: mesh.triangles)
  }

  var mesh: Mesh {
    Mesh(
      positions: positions.values(of: SIMD3<Float>.self),
      triangles: triangles.values(of: Triangle.self))
  }
}
