import CKernels
import SceneModel

/// A sparse point in a view: pixel position and inverse depth.
package struct PatchSeed: Hashable, Sendable {
  /// Pixel coordinates, origin at the top-left corner of the view.
  package var pixel: SIMD2<Float>
  /// 1 / z in the camera frame.
  package var inverseDepth: Float

  package init(pixel: SIMD2<Float>, inverseDepth: Float) {
    self.pixel = pixel
    self.inverseDepth = inverseDepth
  }
}

/// The patch of one pixel: a plane given by its inverse depth at the pixel's center and the
/// gradient of the inverse depth over the pixel grid. An inverse depth of 0 means that there is no
/// patch.
package struct Patch: Hashable, Sendable {
  /// 1 / z in the camera frame, at the pixel's center.
  package var inverseDepth: Float
  /// Change of the inverse depth per pixel in x and y.
  package var gradient: SIMD2<Float>
  /// 1 − ZNCC, the mean of the best two sources; 2 without a patch.
  package var cost: Float

  package init(inverseDepth: Float, gradient: SIMD2<Float>, cost: Float) {
    self.inverseDepth = inverseDepth
    self.gradient = gradient
    self.cost = cost
  }
}

/// The patches of one view, and which of them the filter accepted.
package final class PatchMap: @unchecked Sendable {
  package let view: PatchView
  // Written by one call at a time; `PatchStereo` documents the order of calls.
  let patches: UnsafeMutablePointer<ck_patch>
  let states: UnsafeMutablePointer<UInt8>
  /// Bit mask of the neighbors that confirm each patch; nil unless `filter` recorded it.
  private(set) var visibility: UnsafeMutablePointer<UInt8>?
  var count: Int { view.width * view.height }

  /// A map without patches.
  package init(view: PatchView) {
    self.view = view
    let count = view.width * view.height
    patches = .allocate(capacity: count)
    patches.initialize(
      repeating: ck_patch(inverse_depth: 0, gradient_x: 0, gradient_y: 0, cost: 2), count: count)
    states = .allocate(capacity: count)
    states.initialize(repeating: 0, count: count)
  }

  /// A map whose patches `fill` writes to the given buffer, in the layout of `patchBytes`.
  package init(view: PatchView, fill: (UnsafeMutableRawBufferPointer) throws -> Void) rethrows {
    self.view = view
    let count = view.width * view.height
    patches = .allocate(capacity: count)
    states = .allocate(capacity: count)
    states.initialize(repeating: 0, count: count)
    try fill(
      UnsafeMutableRawBufferPointer(start: patches, count: count * MemoryLayout<ck_patch>.stride))
  }

  deinit {
    patches.deallocate()
    states.deallocate()
    visibility?.deallocate()
  }

  /// Allocates `visibility`.
  func makeVisibility() {
    guard visibility == nil else { return }
    visibility = .allocate(capacity: count)
    visibility?.initialize(repeating: 0, count: count)
  }

  /// The C map, valid as long as this object lives. Without visibility: another thread may just be
  /// allocating that of a neighbor.
  var raw: ck_patch_map {
    ck_patch_map(
      photo: Int32(view.photo.index), view: view.raw, rgb: view.rgb, patches: patches,
      states: states, visibility: nil)
  }

  /// All patches in memory layout and native byte order; valid as long as this object lives.
  package var patchBytes: UnsafeRawBufferPointer {
    UnsafeRawBufferPointer(start: patches, count: count * MemoryLayout<ck_patch>.stride)
  }

  /// The filter's result for each patch, one byte each; valid as long as this object lives.
  package var stateBytes: UnsafeMutableRawBufferPointer {
    UnsafeMutableRawBufferPointer(start: states, count: count)
  }

  /// Bytes per pixel of a map and its view.
  package static let bytesPerPixel = MemoryLayout<ck_patch>.stride + 5

  /// The patch at column `x`, row `y`.
  package subscript(x: Int, y: Int) -> Patch {
    get {
      let raw = patches[y * view.width + x]
      return Patch(
        inverseDepth: raw.inverse_depth, gradient: [raw.gradient_x, raw.gradient_y],
        cost: raw.cost)
    }
    set {
      patches[y * view.width + x] = ck_patch(
        inverse_depth: newValue.inverseDepth, gradient_x: newValue.gradient.x,
        gradient_y: newValue.gradient.y, cost: newValue.cost)
    }
  }

  /// Removes the patches of pixels below `least` in a mask, gray and of the view's size. Must not
  /// be called on a map that another thread may read.
  package func removePatches(outside mask: RasterImage, least: UInt8 = 128) throws {
    guard (mask.width, mask.height, mask.channels) == (view.width, view.height, 1) else {
      throw KernelError.invalidArgument("the mask is not gray or not of the view's size")
    }
    for index in 0..<count where mask.pixels[index] < least {
      patches[index] = ck_patch(inverse_depth: 0, gradient_x: 0, gradient_y: 0, cost: 2)
    }
  }

  /// Number of patches that passed the filter.
  package var acceptedCount: Int { (0..<count).reduce(0) { $0 + (states[$1] != 0 ? 1 : 0) } }

  /// Whether the filter accepted the patch at column `x`, row `y`.
  package func isAccepted(_ x: Int, _ y: Int) -> Bool { states[y * view.width + x] != 0 }
}

/// Patch multi-view stereo on pinhole views (Furukawa and Ponce, PAMI 2010).
package enum PatchStereo {
  /// Parameters of patch optimization.
  package struct Options: Hashable, Codable, Sendable {
    /// Number of resolution levels, each half of the previous one, starting with the view's.
    package var levelCount = 4
    /// Propagation sweeps at the coarsest level.
    package var coarseSweeps = 2
    /// Random planes tried around the current one at the coarsest level.
    package var perturbations = 3
    /// Gauss–Newton steps.
    package var refinementSteps = 2
    /// Gray-level difference at which the bilateral weight is one half.
    package var bilateralContrast: Float = 6
    /// Whether views propagate patches to each other.
    package var expandsAcrossViews = true
    /// Whether patches follow the surface instead of being fronto-parallel.
    package var estimatesNormals = true
    /// Seed of the random perturbations.
    package var seed: UInt32 = 1
    /// Of the inner loops; results differ only by rounding.
    package var instructions = Instructions.automatic

    package init() {}
  }

  /// Parameters of filtering and fusing patches.
  package struct FilterOptions: Hashable, Codable, Sendable {
    /// Maximum 1 − ZNCC of a patch that `minimumAgreeingViews` may confirm.
    package var photometricThreshold: Float = 0.5
    /// Maximum 1 − ZNCC of any patch; between the two thresholds, where texture is weak, one more
    /// view must agree.
    package var weakTextureThreshold: Float = 0.6
    /// Number of other views that must agree; with fewer views all but one, but at least one.
    package var minimumAgreeingViews = 2
    /// Maximum disparity in pixels between a patch and its confirmation, in the coarser view; the
    /// parallax determines the corresponding depth difference.
    package var reprojectionThreshold: Float = 0.6
    /// Maximum relative difference of depth, for small parallax.
    package var depthThreshold: Float = 0.01
    /// Maximum angle between normals in degrees.
    package var normalThresholdDegrees: Float = 60
    /// Relative distance behind a patch at which another view sees through it (a free-space
    /// violation).
    package var contradictionThreshold: Float = 0.01
    /// Number of erosion passes that remove boundary pixels similar to their rejected neighbors
    /// (foreground fattening).
    package var depthEdgePasses = 1
    /// Gray-level difference at which the similarity of two pixels is one half.
    package var depthEdgeContrast: Float = 10
    /// Connected components with fewer patches are removed.
    package var minimumIsland: Int
    /// Maximum distance in pixels of patches that are fused.
    package var fusionThreshold: Float = 0.6
    /// Of the inner loops; results differ only by rounding.
    package var instructions = Instructions.automatic

    package init(minimumIsland: Int = 30) {
      self.minimumIsland = minimumIsland
    }
  }

  /// Maximum number of source views of a reference view.
  package static let maximumSources = 8

  /// Computes the patches of `map`'s view from its seeds and the source views, best first. Throws
  /// `KernelError.degenerate` without usable seeds.
  package static func reconstruct(
    _ map: PatchMap, sources: [PatchView], seeds: [PatchSeed], options: Options,
    control: KernelControl
  ) throws {
    var reference = map.view.raw
    let rawSources = sources.prefix(maximumSources).map(\.raw)
    let rawSeeds = seeds.map {
      ck_patch_seed(x: $0.pixel.x, y: $0.pixel.y, inverse_depth: $0.inverseDepth)
    }
    var rawOptions = options.raw
    try withKernel(control) {
      ck_patches_reconstruct(
        map.patches, &reference, rawSources, rawSources.count, rawSeeds, rawSeeds.count,
        &rawOptions, $0)
    }
    withExtendedLifetime(sources) {}
  }

  /// Computes the patches of `map`'s view from those at half the resolution, which must have been
  /// filtered with `recordsVisibility`. `sources` must be in the same order as for that filter.
  package static func refine(
    _ map: PatchMap, from coarse: PatchMap, sources: [PatchView], options: Options,
    control: KernelControl
  ) throws {
    var (reference, rawCoarse, rawOptions) = (map.view.raw, coarse.raw, options.raw)
    rawCoarse.visibility = UnsafePointer(coarse.visibility)
    let rawSources = sources.prefix(maximumSources).map(\.raw)
    try withExtendedLifetime((coarse, sources)) {
      try withKernel(control) {
        ck_patches_refine(
          map.patches, &reference, rawSources, rawSources.count, &rawCoarse, &rawOptions, $0)
      }
    }
  }

  /// Marks the patches of `map` that enough of its neighbors confirm and not too many contradict
  /// (geometric consistency). With `recordsVisibility`, also stores which neighbors confirm each
  /// patch, for `refine`.
  package static func filter(
    _ map: PatchMap, neighbors: [PatchMap], options: FilterOptions, recordsVisibility: Bool = false,
    control: KernelControl
  ) throws {
    if recordsVisibility { map.makeVisibility() }
    var (rawOptions, rawMap) = (options.raw, map.raw)
    let rawNeighbors = neighbors.map(\.raw)
    try withExtendedLifetime(neighbors) {
      try withKernel(control) {
        ck_patches_filter(
          map.states, map.visibility, &rawMap, rawNeighbors, rawNeighbors.count, &rawOptions, $0)
      }
    }
  }

  /// Expands patches across views and into holes: where the filter rejected patches of `map`, tries
  /// those of its neighbor views and of adjacent pixels; near depth edges, patches are re-estimated
  /// from the texels on their side. The map and all its neighbors must be filtered; the result must
  /// be filtered again.
  package static func complete(
    _ map: PatchMap, neighbors: [PatchMap], options: Options, control: KernelControl
  ) throws -> PatchMap {
    let completed = PatchMap(view: map.view)
    var (rawMap, rawOptions) = (map.raw, options.raw)
    let rawNeighbors = neighbors.prefix(maximumSources).map(\.raw)
    try withExtendedLifetime((map, neighbors)) {
      try withKernel(control) {
        ck_patches_complete(
          completed.patches, &rawMap, rawNeighbors, rawNeighbors.count, &rawOptions, $0)
      }
    }
    return completed
  }

  /// Fuses the accepted patches of `map` with the consistent ones of its neighbors, in the world
  /// frame.
  ///
  /// The map and all its neighbors must be filtered. Surface that several views observe becomes a
  /// point of the view with the highest resolution there, so that maps can be fused in any order.
  package static func fuse(
    _ map: PatchMap, neighbors: [PatchMap], options: FilterOptions, control: KernelControl
  ) throws -> PointCloud {
    var (rawOptions, rawMap) = (options.raw, map.raw)
    let rawNeighbors = neighbors.map(\.raw)
    var fused = [ck_fused_patch](repeating: ck_fused_patch(), count: map.acceptedCount)
    var count = 0
    try withExtendedLifetime(neighbors) {
      try withKernel(control) {
        ck_patches_fuse(
          &fused, &count, &rawMap, rawNeighbors, rawNeighbors.count, &rawOptions, $0)
      }
    }
    return PointCloud(fused.prefix(count))
  }
}

extension PatchStereo.Options {
  fileprivate var raw: ck_patch_options {
    ck_patch_options(
      level_count: Int32(levelCount), coarse_sweeps: Int32(coarseSweeps),
      perturbations: Int32(perturbations), refinement_steps: Int32(refinementSteps),
      bilateral_contrast: bilateralContrast, expands_across_views: expandsAcrossViews ? 1 : 0,
      is_fronto_parallel: estimatesNormals ? 0 : 1, seed: seed, instructions: instructions.raw)
  }
}

extension PatchStereo.FilterOptions {
  fileprivate var raw: ck_patch_filter_options {
    ck_patch_filter_options(
      photometric_threshold: photometricThreshold,
      weak_texture_threshold: max(photometricThreshold, weakTextureThreshold),
      minimum_consistent_views: Int32(minimumAgreeingViews),
      reprojection_threshold: reprojectionThreshold, depth_threshold: depthThreshold,
      normal_cosine: cosine(degrees: normalThresholdDegrees),
      free_space_threshold: contradictionThreshold, depth_edge_passes: Int32(depthEdgePasses),
      depth_edge_contrast: depthEdgeContrast, minimum_island_size: Int32(minimumIsland),
      fusion_threshold: fusionThreshold, instructions: instructions.raw)
  }
}
