import CKernels
import SceneModel

/// Photometric refinement of a surface: its vertices move along their normals to where the photos
/// agree (after Vu, Keriven, Labatut and Pons, "High Accuracy and Visibility-Consistent Dense
/// Multiview Stereo", PAMI 2012).
///
/// Each photo is reprojected into another one via the surface, and compared with it in windows.
/// Photometric differences along the normals (Gauss–Newton) and bending energy are minimized
/// jointly; the bending term is relaxed at creases. Not thread-safe.
package final class SurfaceRefinement {
  /// Parameters of the refinement.
  package struct Options: Hashable, Codable, Sendable {
    /// Number of rounds of comparing photos and moving vertices by at most half a pixel. Chosen.
    package var rounds = 3
    /// Maximum number of photos that each photo is compared with. Chosen.
    package var neighbors = 8
    /// Photos are compared by normalized cross-correlation in windows of `2 × radius + 1` pixels
    /// per side. Chosen.
    package var radius = 6
    /// Standard deviation of luminance, 0…255, below which a window counts as untextured. Chosen:
    /// two to three times the noise of photos.
    package var noise: Float = 6
    /// Windows with a lower correlation are ignored: they show different surfaces, or noise.
    /// Chosen.
    package var minimumCorrelation: Float = 0.4
    /// Weight of smoothness relative to the photos, for edges of one pixel length. Chosen.
    package var smoothness: Float = 100

    package init() {}
  }

  private let handle: OpaquePointer
  private let mesh: Mesh

  /// Throws `KernelError.invalidArgument` for a mesh without triangles or with invalid values, and
  /// for options out of range.
  package init(_ mesh: Mesh, options: Options = Options(), _ control: KernelControl) throws {
    var handle: OpaquePointer?
    var raw = ck_photo_refinement_options(
      rounds: Int32(clamping: options.rounds), neighbors: Int32(clamping: options.neighbors),
      radius: Int32(clamping: options.radius), noise: options.noise,
      minimum_correlation: options.minimumCorrelation,
      smoothness: options.smoothness)
    try withKernel(control) { control in
      mesh.withKernelValue { ck_photo_refinement_create($0, &raw, control, &handle) }
    }
    guard let handle else { throw KernelError.failed("the mesh can't be prepared") }
    self.handle = handle
    self.mesh = mesh
  }

  deinit { ck_photo_refinement_free(handle) }

  /// Adds a photo; pixels outside its mask are not compared. Stores two bytes per pixel.
  package func add(_ view: PinholeView, _ control: KernelControl) throws {
    let (image, mask) = (view.image, view.mask)
    guard image.channels == 3, mask.map({ $0.isGray(ofTheSizeOf: image) }) ?? true else {
      throw KernelError.invalidArgument(
        "the view isn't in color, or its mask is not gray or not of its size")
    }
    var rawView = ck_view(view)
    try withKernel(control) { control in
      ck_photo_refinement_add(handle, &rawView, image.pixels, mask?.pixels, control)
    }
  }

  /// The mesh with moved vertices, and the number of vertices that the photos constrain. Boundary
  /// vertices are fixed, as are those where fewer than two photos show texture. Normals are not
  /// updated.
  package func run(_ control: KernelControl) throws -> (mesh: Mesh, moved: Int) {
    var result = mesh
    var moved = 0
    try withKernel(control) { control in
      result.positions.withMutableSpan { ck_photo_refinement_run(handle, control, $0, &moved) }
    }
    return (result, moved)
  }
}
