import Foundation
import SceneModel

/// A surface that hides tiles from photos, and the photos' gains on it, as one process leaves them
/// for others.
struct OccluderRecord: LargeUnitValue {
  private var positions: Data
  private var triangles: Data

  /// By photo.
  let gains: [ExposureGain]

  init(_ mesh: Mesh, gains: [ExposureGain]) {
    self.gains = gains
    positions = Data(bytesOf: mesh.positions)
    triangles = Data(bytesOf: mesh.triangles)
  }

  var mesh: Mesh {
    Mesh(
      positions: positions.values(of: SIMD3<Float>.self),
      triangles: triangles.values(of: Triangle.self))
  }
}
