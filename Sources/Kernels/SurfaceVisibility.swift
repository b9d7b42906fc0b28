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

/// A registered photo as ray queries need it.
package struct ViewingPhoto: Sendable {
  fileprivate var raw: ck_posed_photo

  /// `camera`'s distortion is left out: the frame is that of its pinhole.
  package init(_ camera: Camera, cameraFromWorld: RigidTransform) {
    let (r, t) = (cameraFromWorld.rotation.matrix, cameraFromWorld.translation)
    func row(_ f: Double, _ c: Double, _ a: SIMD3<Double>, _ at: Double) -> [Float] {
      let v = f * a + c * r.row2
      return [Float(v.x), Float(v.y), Float(v.z), Float(f * at + c * t.z)]
    }
    let x = row(camera.focalLength.x, camera.principalPoint.x, r.row0, t.x)
    let y = row(camera.focalLength.y, camera.principalPoint.y, r.row1, t.y)
    let z = row(0, 1, .zero, 0)
    let center = SIMD3<Float>(cameraFromWorld.center)
    raw = ck_posed_photo(
      projection: (
        x[0], x[1], x[2], x[3], y[0], y[1], y[2], y[3], z[0], z[1], z[2], z[3]
      ), center: (center.x, center.y, center.z), width: Float(camera.width),
      height: Float(camera.height))
  }
}

extension Mesh {
  /// For every point of the surface the number of photos that have it in their frame, face to face
  /// (at `minimumCosine` to its normal or more) and not hidden by this mesh.
  package func viewingPhotos(
    of points: [SIMD3<Float>], normals: [SIMD3<Float>], photos: [ViewingPhoto],
    minimumCosine: Float, clearance: Float, _ control: KernelControl
  ) throws -> [UInt16] {
    guard points.count == normals.count else {
      throw KernelError.invalidArgument("as many normals as points are needed")
    }
    var counts = [UInt16](repeating: 0, count: points.count)
    let raw = photos.map(\.raw)
    let stride = MemoryLayout<SIMD3<Float>>.stride
    try withKernel(control) { control in
      positions.withUnsafeBytes { vertices in
        triangles.withUnsafeBytes { triangles in
          points.withUnsafeBytes { points in
            normals.withUnsafeBytes { normals in
              ck_count_viewing_photos(
                vertices.floats, stride, vertices.count / stride,
                triangles.baseAddress?.assumingMemoryBound(to: UInt32.self),
                triangles.count / MemoryLayout<Triangle>.stride, points.floats, normals.floats,
                stride, points.count / stride, raw, raw.count, minimumCosine, clearance, control,
                &counts)
            }
          }
        }
      }
    }
    return counts
  }
}
