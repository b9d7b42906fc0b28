import CKernels
import SceneModel

/// A texture atlas that is painted view by view.
///
/// Not thread-safe; kernels use the control's threads internally.
package final class TextureCanvas {
  /// Texels per side of the square texture.
  package let side: Int
  /// The textured surface, which the kernel reads; kept alive as long as the canvas.
  private let scene: RayScene
  private let handle: OpaquePointer

  /// `corners` are the texel coordinates, y down, of each triangle's three corners. Charts are
  /// extended by `gutter` texels.
  package init(
    _ scene: RayScene, corners: [SIMD2<Float>], side: Int, gutter: Int = 2,
    _ control: KernelControl
  ) throws {
    guard corners.count == 3 * scene.triangleCount else {
      throw KernelError.invalidArgument("corners and triangles differ in number")
    }
    var handle: OpaquePointer?
    try withKernel(control) { control in
      corners.withUnsafeFloats { corners in
        ck_atlas_create(
          scene.handle, corners, scene.triangleCount, Int32(clamping: side),
          Int32(clamping: gutter), control, &handle)
      }
    }
    guard let handle else { throw KernelError.failed("the texture can't be made") }
    (self.scene, self.side, self.handle) = (scene, side, handle)
  }

  deinit { ck_atlas_free(handle) }

  /// The fraction of the texels whose center lies in a triangle.
  package var usage: Double {
    Double(ck_atlas_covered_count(handle)) / Double(side * side)
  }

  /// Number of texels covered by several triangles.
  package var overlapCount: Int { ck_atlas_overlap_count(handle) }

  /// Adds a view's colors, multiplied by `gain`; without a view, only the offsets.
  package func paint(
    _ paints: [FacePaint], from view: PinholeView?, gain: SIMD3<Float> = .one,
    _ control: KernelControl
  ) throws {
    let raw = paints.map { paint in
      let (a, b, c) = paint.offsets
      return ck_paint(
        face: UInt32(bitPattern: paint.face),
        weights: (paint.weights.x, paint.weights.y, paint.weights.z),
        offsets: (a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z))
    }
    try withKernel(control) { control in
      if let view {
        var rawView = ck_view(view)
        return ck_atlas_paint(
          handle, &rawView, view.image.pixels, [gain.x, gain.y, gain.z], raw, raw.count, control)
      }
      return ck_atlas_paint(handle, nil, nil, nil, raw, raw.count, control)
    }
  }

  /// The accumulated colors, RGB, with the space between charts filled from their boundaries.
  package func colors(_ control: KernelControl) throws -> RasterImage {
    var result = RasterImage(width: side, height: side, channels: 3)
    try withKernel(control) { ck_atlas_copy_colors(handle, $0, &result.pixels) }
    return result
  }

  /// Bakes the normals of the dense surface in the tangent frame of the textured one, and its
  /// signed distance along the normal, 0 and 255 at ∓`maximumDistance`.
  package func bake(
    _ source: BakeSource, displacement: Bool, _ control: KernelControl
  ) throws -> (normals: RasterImage, displacement: RasterImage?) {
    var image = RasterImage(width: side, height: side, channels: 3)
    var heights = displacement ? RasterImage(width: side, height: side, channels: 1) : nil
    try with(source, control) { raw, control in
      guard heights != nil else { return ck_atlas_bake(handle, &raw, control, &image.pixels, nil) }
      var pixels = [UInt8](repeating: 0, count: side * side)
      defer { heights?.pixels = pixels }
      return ck_atlas_bake(handle, &raw, control, &image.pixels, &pixels)
    }
    return (image, heights)
  }

  /// Ambient occlusion: the cosine-weighted fraction of the hemisphere above each texel that the
  /// dense surface leaves unoccluded within `maximumDistance`; 255 is unoccluded.
  ///
  /// Texels share rays with adjacent ones, 16 × `raysPerTexel` in total.
  package func occlusion(
    _ source: BakeSource, raysPerTexel: Int, maximumDistance: Float, _ control: KernelControl
  ) throws -> RasterImage {
    var image = RasterImage(width: side, height: side, channels: 1)
    try with(source, control) { raw, control in
      ck_atlas_occlusion(
        handle, &raw, max(0, raysPerTexel), maximumDistance, control, &image.pixels)
    }
    return image
  }

  /// Calls `body` with the C representation of a bake source, valid only during the call.
  private func with(
    _ source: BakeSource, _ control: KernelControl,
    _ body: (inout ck_bake_source, UnsafePointer<ck_control>) -> ck_status
  ) throws {
    guard source.cornerNormals.count == 3 * scene.triangleCount,
      source.cornerTangents.count == 3 * scene.triangleCount
    else { throw KernelError.invalidArgument("corner normals and corners differ in number") }
    let normals = KernelArray(source.cornerNormals.flatMap { [$0.x, $0.y, $0.z] })
    let tangents = KernelArray(source.cornerTangents.flatMap { [$0.x, $0.y, $0.z, $0.w] })
    try withExtendedLifetime((normals, tangents)) {
      try withKernel(control) { control in
        source.denseNormals.withSpan { denseNormals in
          var raw = ck_bake_source(
            maximum_distance: source.maximumDistance, corner_normals: normals.base,
            corner_tangents: tangents.base, dense: source.dense.handle,
            dense_normals: denseNormals)
          return body(&raw, control)
        }
      }
    }
  }
}
