import CKernels
import SceneModel

/// Patch multi-view stereo on pinhole views (Furukawa and Ponce, PAMI 2010).
package enum PatchStereo {
  /// Parameters of patch optimization.
  package struct Options: Hashable, Codable, Sendable {
    /// Number of resolution levels, each half of the previous one, starting with the view's.
    /// Chosen: the levels below half resolution gain nothing on boot, which has many sparse points
    /// (docs/experiments/2026-11-dense-stage.md, Contribution of each step).
    package var levelCount = 4
    /// Propagation sweeps at the coarsest level. Chosen.
    package var coarseSweeps = 2
    /// Number of random perturbations of the current plane to test at the coarsest level. Chosen.
    package var perturbations = 3
    /// Gauss–Newton steps. Chosen.
    package var refinementSteps = 2
    /// Gray-level difference at which the bilateral weight is one half. Measured: on boot at half
    /// resolution, 6 gave an F-score of 0.966 at 0.5 mm, 10 gave 0.965
    /// (docs/experiments/2026-11-dense-stage.md, Experiments).
    package var bilateralContrast: Float = 6
    /// Whether views propagate patches to each other.
    package var expandsAcrossViews = true
    /// Whether patches follow the surface instead of being fronto-parallel.
    package var estimatesNormals = true
    /// Seed of the random perturbations. Chosen: any value serves.
    package var seed: UInt32 = 1
    /// Of the inner loops; results differ only by rounding.
    package var instructions = Instructions.automatic

    package init() {}
  }

  /// Parameters of filtering and fusing patches.
  package struct FilterOptions: Hashable, Codable, Sendable {
    /// Maximum 1 − ZNCC of a patch that `minimumAgreeingViews` may confirm. Higher than the
    /// thresholds in the literature for ZNCC alone, because noise in weak texture raises this cost
    /// and each patch is also confirmed geometrically by other views. Measured: tuned on the sets
    /// marked so in Benchmarks/sets.json.
    package var photometricThreshold: Float = 0.5
    /// Maximum 1 − ZNCC of any patch; between the two thresholds, where texture is weak, one more
    /// view must agree. Measured: as above.
    package var weakTextureThreshold: Float = 0.6
    /// Number of other views that must agree; with fewer views all but one, but at least one.
    /// Measured: as above.
    package var minimumAgreeingViews = 2
    /// Maximum disparity in pixels between a patch and its confirmation, in the coarser view; the
    /// parallax determines the corresponding depth difference. Measured: on boot at half
    /// resolution, 0.6 gave an F-score of 0.966 at 0.5 mm, 0.8 gave 0.964 and 1 gave 0.965
    /// (docs/experiments/2026-11-dense-stage.md, Experiments).
    package var reprojectionThreshold: Float = 0.6
    /// Maximum relative difference of depth, for small parallax. Measured: tuned on the sets marked
    /// so in Benchmarks/sets.json.
    package var depthThreshold: Float = 0.01
    /// Maximum angle between normals in degrees. Measured: as above.
    package var normalThresholdDegrees: Float = 60
    /// Relative depth difference from which another view that sees past a patch counts as a
    /// free-space violation. Measured: as above.
    package var contradictionThreshold: Float = 0.01
    /// Number of erosion passes that remove boundary pixels similar to their rejected neighbors
    /// (foreground fattening). Chosen.
    package var depthEdgePasses = 1
    /// Gray-level difference at which the similarity of two pixels is one half. Chosen.
    package var depthEdgeContrast: Float = 10
    /// Connected components with fewer patches are removed.
    package var minimumIsland: Int
    /// Maximum disparity at which consistent patches are fused, in pixels of the coarser view.
    /// Chosen: as `reprojectionThreshold`.
    package var fusionThreshold: Float = 0.6
    /// Of the inner loops; results differ only by rounding.
    package var instructions = Instructions.automatic

    package init(minimumIsland: Int = 30) {
      self.minimumIsland = minimumIsland
    }
  }

  /// Maximum number of source views of a reference view. Limit: the bits of a byte.
  package static let maximumSources = 8

  /// Computes the patches of `map`'s view from its seeds and the source views, best first. Throws
  /// `KernelError.degenerate` without usable seeds.
  package static func reconstruct(
    _ map: inout PatchMapBuilder, sources: [PatchView], seeds: [PatchSeed], options: Options,
    control: KernelControl
  ) throws {
    let patches = map.patches.baseAddress
    var reference = map.view.raw
    let rawSources = sources.prefix(maximumSources).map(\.raw)
    let rawSeeds = seeds.map {
      ck_patch_seed(x: $0.pixel.x, y: $0.pixel.y, inverse_depth: $0.inverseDepth)
    }
    var rawOptions = options.raw
    try withExtendedLifetime(sources) {
      try withKernel(control) {
        ck_patches_reconstruct(
          &reference, rawSources, rawSources.count, rawSeeds, rawSeeds.count, &rawOptions, $0,
          patches)
      }
    }
  }

  /// Computes the patches of `map`'s view from those at half the resolution, which must have been
  /// filtered with `recordsVisibility`. `sources` must be in the same order as the neighbors of
  /// that filter.
  package static func refine(
    _ map: inout PatchMapBuilder, from coarse: PatchMap, sources: [PatchView], options: Options,
    control: KernelControl
  ) throws {
    let patches = map.patches.baseAddress
    var (reference, rawCoarse, rawOptions) = (map.view.raw, coarse.raw, options.raw)
    let rawSources = sources.prefix(maximumSources).map(\.raw)
    try withExtendedLifetime((coarse, sources)) {
      try withKernel(control) {
        ck_patches_refine(
          &reference, rawSources, rawSources.count, &rawCoarse, &rawOptions, $0, patches)
      }
    }
  }

  /// Accepts the patches of `map` that enough of its neighbors confirm and not too many contradict
  /// (geometric consistency). With `recordsVisibility`, also records which neighbors confirm each
  /// patch, for `refine`.
  package static func filter(
    _ map: PatchMap, neighbors: [PatchMap], options: FilterOptions,
    recordsVisibility: Bool = false, control: KernelControl
  ) throws -> PatchStates {
    var (rawOptions, rawMap) = (options.raw, map.raw)
    let rawNeighbors = neighbors.map(\.raw)
    var visibility: FrozenArray<UInt8>?
    let states = try FrozenArray<UInt8>(count: map.count) { states in
      let record = { (visibility: UnsafeMutablePointer<UInt8>?) in
        try withExtendedLifetime((map, neighbors)) {
          try withKernel(control) {
            ck_patches_filter(
              &rawMap, rawNeighbors, rawNeighbors.count, &rawOptions, $0, states.baseAddress,
              visibility)
          }
        }
      }
      if recordsVisibility {
        visibility = try FrozenArray(count: map.count) { try record($0.baseAddress) }
      } else {
        try record(nil)
      }
    }
    return PatchStates(states: states, visibility: visibility)
  }

  /// Propagates patches across views and into holes: where the filter rejected patches of `map`,
  /// tests those of its neighbors and of adjacent pixels. Patches near depth discontinuities are
  /// re-estimated from the texels on their side of the edge. The map and all its neighbors must be
  /// filtered; the result must be filtered again.
  package static func complete(
    _ map: PatchMap, neighbors: [PatchMap], options: Options, control: KernelControl
  ) throws -> PatchMapBuilder {
    let completed = PatchMapBuilder(view: map.view)
    let patches = completed.patches.baseAddress
    var (rawMap, rawOptions) = (map.raw, options.raw)
    let rawNeighbors = neighbors.prefix(maximumSources).map(\.raw)
    try withExtendedLifetime((map, neighbors)) {
      try withKernel(control) {
        ck_patches_complete(
          &rawMap, rawNeighbors, rawNeighbors.count, &rawOptions, $0, patches)
      }
    }
    return completed
  }

  /// Fuses the accepted patches of `map` with the consistent ones of its neighbors, in the world
  /// frame.
  ///
  /// The map and all its neighbors must be filtered. A surface element that several views observe
  /// becomes a point of the view with the smallest footprint there, so that maps can be fused in
  /// any order.
  package static func fuse(
    _ map: PatchMap, neighbors: [PatchMap], options: FilterOptions, control: KernelControl
  ) throws -> PointCloud {
    var (rawOptions, rawMap) = (options.raw, map.raw)
    let rawNeighbors = neighbors.map(\.raw)
    let capacity = map.acceptedCount
    var fused = [ck_fused_patch](repeating: ck_fused_patch(), count: capacity)
    var count = 0
    try withExtendedLifetime((map, neighbors)) {
      try withKernel(control) {
        ck_patches_fuse(
          &rawMap, rawNeighbors, rawNeighbors.count, &rawOptions, $0, &fused, capacity, &count)
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
      bilateral_contrast: bilateralContrast, expands_across_views: expandsAcrossViews,
      is_fronto_parallel: !estimatesNormals, seed: seed, instructions: instructions.raw)
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
