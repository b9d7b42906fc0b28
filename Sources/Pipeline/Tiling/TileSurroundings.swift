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

extension Data {
  fileprivate init(bytesOf values: [some BitwiseCopyable]) {
    self = values.withUnsafeBytes { Data($0) }
  }

  fileprivate func values<Value: BitwiseCopyable>(of type: Value.Type) -> [Value] {
    withUnsafeBytes { bytes in
      (0..<bytes.count / MemoryLayout<Value>.stride).map {
        bytes.loadUnaligned(fromByteOffset: $0 * MemoryLayout<Value>.stride, as: type)
      }
    }
  }
}
