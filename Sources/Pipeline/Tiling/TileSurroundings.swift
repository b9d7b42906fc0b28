import Foundation
import SceneModel

/// What lies around tiles: it limits how far their surfaces reach, and hides them from photos.
struct TileSurroundings: LargeUnitValue {
  /// All points that the photos observe, thinned.
  var observed: PointCloud
  private var occluderPositions: Data
  private var occluderTriangles: Data

  init(observed: PointCloud, occluders: Mesh) {
    self.observed = observed
    occluderPositions = Data(bytesOf: occluders.positions)
    occluderTriangles = Data(bytesOf: occluders.triangles)
  }

  /// The surface of the whole scene, of few triangles.
  var occluders: Mesh {
    Mesh(
      positions: occluderPositions.values(of: SIMD3<Float>.self),
      triangles: occluderTriangles.values(of: Triangle.self))
  }
}
