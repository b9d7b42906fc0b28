import CKernels
import SceneModel

extension Mesh {
  /// For every triangle the number of photos that see a point behind it, which it would hide.
  ///
  /// `clearances` holds for each point of the cloud how far before it the ray from the camera ends;
  /// `centers` the camera centre of each photo in the world.
  package func photosSeeingThrough(
    to cloud: PointCloud, clearances: [Float], centers: [SIMD3<Float>], _ control: KernelControl
  ) throws -> [UInt16] {
    guard clearances.count == cloud.count, cloud.photoOffsets.count == cloud.count + 1,
      Int(cloud.photoOffsets.last ?? 0) <= cloud.photoIndices.count
    else { throw KernelError.invalidArgument("the cloud's arrays do not fit each other") }
    var counts = [UInt16](repeating: 0, count: triangles.count)
    guard !triangles.isEmpty, cloud.count > 0 else { return counts }
    let packedCenters = centers.flatMap { [$0.x, $0.y, $0.z] }
    let stride = MemoryLayout<SIMD3<Float>>.stride
    try withKernel(control) { control in
      positions.withUnsafeBytes { vertices in
        triangles.withUnsafeBytes { triangles in
          cloud.positions.withUnsafeBytes { points in
            ck_seen_through(
              vertices.floats, stride, vertices.count / stride,
              triangles.baseAddress?.assumingMemoryBound(to: UInt32.self), counts.count,
              points.floats, stride, clearances, clearances.count, cloud.photoOffsets,
              cloud.photoIndices, packedCenters, centers.count, control, &counts)
          }
        }
      }
    }
    return counts
  }
}
