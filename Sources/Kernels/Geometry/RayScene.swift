import CKernels
import SceneModel

/// A mesh prepared for ray casting with Embree.
package final class RayScene: Sendable {
  /// Criteria of visibility in a view.
  package struct ObservationOptions: Hashable, Codable, Sendable {
    /// Triangles at a smaller cosine count as not visible. Chosen.
    package var minimumCosine: Float = 0.15
    /// Minimum distance in pixels from the image border and from occluding edges. Chosen.
    package var margin: Float = 4

    package init() {}
  }

  /// Immutable after `init`, so that threads may share it.
  nonisolated(unsafe) let handle: OpaquePointer
  /// Number of triangles of the mesh.
  package let triangleCount: Int

  /// Throws `KernelError.invalidArgument` for a mesh without triangles or with invalid values.
  package init(_ mesh: Mesh, _ control: KernelControl) throws {
    var handle: OpaquePointer?
    try withKernel(control) { control in
      mesh.withKernelValue { ck_ray_scene_create($0, control, &handle) }
    }
    guard let handle else { throw KernelError.failed("the mesh can't be prepared") }
    self.handle = handle
    triangleCount = mesh.triangles.count
  }

  deinit { ck_ray_scene_free(handle) }

  /// The triangles that a view sees completely, inside its mask if it has one, in ascending order.
  package func observations(
    in view: PinholeView, options: ObservationOptions = ObservationOptions(),
    _ control: KernelControl
  ) throws -> [FaceObservation] {
    if let mask = view.mask, !mask.isGray(ofTheSizeOf: view.image) {
      throw KernelError.invalidArgument("the mask is not gray or not of the view's size")
    }
    var raw = [ck_face_observation](repeating: ck_face_observation(), count: triangleCount)
    var rawView = ck_view(view)
    var rawOptions = ck_observe_options(
      minimum_cosine: options.minimumCosine, margin: options.margin)
    try withKernel(control) { control in
      ck_observe_faces(
        handle, &rawView, view.image.pixels, view.mask?.pixels, &rawOptions, control, &raw)
    }
    var result: [FaceObservation] = []
    result.reserveCapacity(raw.count { $0.area > 0 })
    for (face, value) in raw.enumerated() where value.area > 0 {
      result.append(
        FaceObservation(
          face: Int32(face), area: value.area, cosine: value.cosine, gradient: value.gradient,
          isClear: value.is_clear, isInterior: value.is_interior,
          color: SIMD3(value.color.0, value.color.1, value.color.2)))
    }
    return result
  }

  /// Whether the surface lies between each point of `origins` and the point of `targets` at the
  /// same index. The origins may be on the surface: the first thousandth of the way is ignored.
  package func isBlocked(
    from origins: [SIMD3<Float>], to targets: [SIMD3<Float>], _ control: KernelControl
  ) throws -> [Bool] {
    var blocked = [UInt8](repeating: 0, count: origins.count)
    try withKernel(control) { control in
      withSpans(origins, targets) { ck_find_blocked(handle, $0, $1, control, &blocked) }
    }
    return blocked.map { $0 != 0 }
  }
}

extension Array where Element == SIMD2<Float> {
  /// Calls `body` with the array's memory, two floats per vector.
  func withUnsafeFloats<Result>(_ body: (UnsafePointer<Float>?) -> Result) -> Result {
    withUnsafeBytes { body($0.baseAddress?.assumingMemoryBound(to: Float.self)) }
  }
}
