import CKernels
import SceneModel

/// A surface that is being fitted to photos: its vertices move along their normals to where the
/// photos agree (after Vu, Keriven, Labatut and Pons, "High Accuracy and Visibility-Consistent Dense
/// Multiview Stereo", PAMI 2012).
///
/// Each photo is drawn as another one would show it by way of the surface, and compared with that in
/// windows. The differences' least squares along the normals (Gauss–Newton) and the least bending of
/// the surface are found together; bending gives way at creases. Use it from one thread.
package final class SurfaceRefinement {
  package struct Options: Hashable, Codable, Sendable {
    /// Times that photos are compared and vertices moved, each by half a pixel at most.
    package var rounds = 3
    /// Photos that each photo is compared with, at most.
    package var neighbours = 8
    /// Photos are compared by what stands out from windows of `2 × radius + 1` pixels a side.
    package var radius = 6
    /// Standard deviation of luminance, 0…255, below which a window has no texture: some two or three
    /// times the noise of photos.
    package var noise: Float = 6
    /// Windows with a smaller correlation show something else, or noise.
    package var minimumCorrelation: Float = 0.4
    /// Weight of smoothness against the photos, for edges of the length of a pixel.
    package var smoothness: Float = 100

    package init() {}
  }

  private let handle: OpaquePointer
  private let mesh: Mesh

  /// Throws `KernelError.invalidArgument` for a mesh without triangles or with bad values, and for
  /// options out of range.
  package init(_ mesh: Mesh, options: Options = Options(), _ control: KernelControl) throws {
    var handle: OpaquePointer?
    var raw = ck_photo_refinement_options(
      rounds: Int32(clamping: options.rounds), neighbours: Int32(clamping: options.neighbours),
      radius: Int32(clamping: options.radius), noise: options.noise,
      minimum_correlation: options.minimumCorrelation,
      smoothness: options.smoothness)
    try withKernel(control) { control in
      mesh.positions.withUnsafeFloats { positions in
        mesh.triangles.withUnsafeIndices { triangles in
          ck_photo_refinement_create(
            positions, MemoryLayout<SIMD3<Float>>.stride, mesh.positions.count, triangles,
            mesh.triangles.count, &raw, control, &handle)
        }
      }
    }
    guard let handle else { throw KernelError.failed("the mesh can't be prepared") }
    self.handle = handle
    self.mesh = mesh
  }

  deinit { ck_photo_refinement_free(handle) }

  /// Adds a photo; what its mask leaves out isn't compared. Keeps two bytes a pixel.
  package func add(_ view: PinholeView, _ control: KernelControl) throws {
    let (image, mask) = (view.image, view.mask)
    guard image.channels == 3, mask.map({ $0.isGray(ofTheSizeOf: image) }) ?? true else {
      throw KernelError.invalidArgument(
        "the view isn't in colour, or its mask is not gray or not of its size")
    }
    var pinhole = ck_pinhole(view)
    try withKernel(control) { control in
      ck_photo_refinement_add(handle, &pinhole, image.pixels, mask?.pixels, control)
    }
  }

  /// The mesh with its vertices moved, and how many of them the photos determine. Those at borders
  /// stay, and those where no two photos show texture. Normals are those of before.
  package func run(_ control: KernelControl) throws -> (mesh: Mesh, moved: Int) {
    var result = mesh
    var moved = 0
    try withKernel(control) { control in
      result.positions.withUnsafeMutableBytes {
        ck_photo_refinement_run(
          handle, control, $0.baseAddress?.assumingMemoryBound(to: Float.self),
          MemoryLayout<SIMD3<Float>>.stride, &moved)
      }
    }
    return (result, moved)
  }
}

extension RasterImage {
  fileprivate func isGray(ofTheSizeOf image: RasterImage) -> Bool {
    (width, height, channels) == (image.width, image.height, 1)
  }
}
