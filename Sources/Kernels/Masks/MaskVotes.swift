import CKernels
import SceneModel

/// Counts, for each of a set of points, the photos that have it in their frame and those whose mask
/// contains it.
package struct MaskVotes: Sendable {
  /// World frame.
  package let points: [SIMD3<Float>]
  package private(set) var seen: [UInt16]
  package private(set) var inside: [UInt16]

  package init(_ points: [SIMD3<Float>]) {
    self.points = points
    seen = [UInt16](repeating: 0, count: points.count)
    inside = seen
  }

  /// Adds the votes of one photo. The mask is gray, 128 or more on the object, and has the size of
  /// the camera.
  package mutating func add(
    _ mask: RasterImage, of camera: Camera, at cameraFromWorld: RigidTransform
  ) throws {
    var (rawCamera, pose) = (ck_camera(camera), ck_pose(cameraFromWorld))
    try withKernel(KernelControl()) { _ in
      points.withSpan { points in
        mask.withKernelPixels { mask in
          ck_count_mask_hits(points, &rawCamera, &pose, mask, &seen, &inside)
        }
      }
    }
  }

  /// Adds the votes that other photos gave to the same points.
  package mutating func add(_ other: MaskVotes) {
    for index in points.indices {
      seen[index] += other.seen[index]
      inside[index] += other.inside[index]
    }
  }
}
