import CKernels
import SceneModel

/// A sparse point in a view: pixel of the view and inverse depth.
package struct PatchSeed: Hashable, Sendable {
  package var pixel: SIMD2<Float>
  package var inverseDepth: Float

  package init(pixel: SIMD2<Float>, inverseDepth: Float) {
    self.pixel = pixel
    self.inverseDepth = inverseDepth
  }
}

/// The patch of one pixel: a plane as its inverse depth at the pixel's centre and the gradient of
/// the inverse depth over the pixel grid. An inverse depth of 0 means that there is no patch.
package struct Patch: Hashable, Sendable {
  package var inverseDepth: Float
  package var gradient: SIMD2<Float>
  /// 1 − ZNCC, the mean of the best two sources; 2 where there is no patch.
  package var cost: Float

  package init(inverseDepth: Float, gradient: SIMD2<Float>, cost: Float) {
    self.inverseDepth = inverseDepth
    self.gradient = gradient
    self.cost = cost
  }
}

/// The patches of one view, and which of them were accepted.
package final class PatchMap: @unchecked Sendable {
  package let view: PatchView
  // Written by one call at a time; `PatchStereo` says in which order calls go.
  let patches: UnsafeMutablePointer<ck_patch>
  let states: UnsafeMutablePointer<UInt8>
  /// The neighbours that agree with each patch, where `filter` was asked to tell.
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

  /// A map whose patches `fill` puts into the buffer that it is given, as `patchBytes` has them.
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

  /// Makes room for what `visibility` tells.
  func makeVisibility() {
    guard visibility == nil else { return }
    visibility = .allocate(capacity: count)
    visibility?.initialize(repeating: 0, count: count)
  }

  /// The C map, valid as long as this object lives. Without visibility: of a neighbour it may just be
  /// made room for.
  var raw: ck_patch_map {
    ck_patch_map(
      photo: Int32(view.photo.index), view: view.raw, rgb: view.rgb, patches: patches,
      states: states, visibility: nil)
  }

  /// All patches as they are in memory, in the machine's byte order; valid as long as this object
  /// lives.
  package var patchBytes: UnsafeRawBufferPointer {
    UnsafeRawBufferPointer(start: patches, count: count * MemoryLayout<ck_patch>.stride)
  }

  /// What became of each patch in the filter, a byte each; valid as long as this object lives.
  package var stateBytes: UnsafeMutableRawBufferPointer {
    UnsafeMutableRawBufferPointer(start: states, count: count)
  }

  /// Bytes that a map and its view take a pixel.
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

  /// Removes the patches of pixels that are below `least` in a mask, gray and of the view's size. Not
  /// for a map that another thread may read.
  package func removePatches(outside mask: RasterImage, least: UInt8 = 128) throws {
    guard (mask.width, mask.height, mask.channels) == (view.width, view.height, 1) else {
      throw KernelError.invalidArgument("the mask is not gray or not of the view's size")
    }
    for index in 0..<count where mask.pixels[index] < least {
      patches[index] = ck_patch(inverse_depth: 0, gradient_x: 0, gradient_y: 0, cost: 2)
    }
  }

  /// Patches that passed the filter.
  package var acceptedCount: Int { (0..<count).reduce(0) { $0 + (states[$1] != 0 ? 1 : 0) } }

  package func isAccepted(_ x: Int, _ y: Int) -> Bool { states[y * view.width + x] != 0 }
}

/// Patch multi-view stereo on pinhole views (Furukawa and Ponce, PAMI 2010).
package enum PatchStereo {
  /// How patches are made.
  package struct Options: Hashable, Codable, Sendable {
    /// Resolutions, each half of the next, from that of the view down.
    package var levelCount = 4
    /// Sweeps of expansion at the coarsest level.
    package var coarseSweeps = 2
    /// Random planes tried around the current one at the coarsest level.
    package var perturbations = 3
    /// Gauss–Newton steps.
    package var refinementSteps = 2
    /// Grey levels at which the bilateral weight is one half.
    package var bilateralContrast: Float = 6
    /// Views offer each other their patches.
    package var expandsAcrossViews = true
    /// Patches follow the surface instead of facing the camera.
    package var estimatesNormals = true
    package var seed: UInt32 = 1
    /// Of the inner loops; results differ by rounding only.
    package var instructions = Instructions.automatic

    package init() {}
  }

  /// Which patches are kept and how they are joined.
  package struct FilterOptions: Hashable, Codable, Sendable {
    /// Largest 1 − ZNCC of a patch that `minimumAgreeingViews` may confirm.
    package var photometricThreshold: Float = 0.5
    /// Largest 1 − ZNCC of a patch; between the two thresholds, where texture is weak, one more view
    /// must agree.
    package var weakTextureThreshold: Float = 0.6
    /// Other views that must agree; all but one where there are fewer, but always one.
    package var minimumAgreeingViews = 2
    /// Pixels of disparity between a patch and its confirmation, in the coarser view: what that means
    /// for depth follows from the parallax.
    package var reprojectionThreshold: Float = 0.6
    /// Relative difference of depth, where the parallax is small.
    package var depthThreshold: Float = 0.01
    /// Largest angle between normals in degrees.
    package var normalThresholdDegrees: Float = 60
    /// Relative distance behind a patch at which another view sees through it.
    package var contradictionThreshold: Float = 0.01
    /// How often pixels that look like their rejected neighbours are peeled off the border.
    package var fringePasses = 1
    /// Grey levels that make a pixel half like another.
    package var fringeContrast: Float = 10
    /// Connected patches fewer than this are removed.
    package var minimumIsland: Int
    /// Pixels within which confirmations are fused.
    package var fusionThreshold: Float = 0.6
    /// Of the inner loops; results differ by rounding only.
    package var instructions = Instructions.automatic

    package init(minimumIsland: Int = 30) {
      self.minimumIsland = minimumIsland
    }
  }

  /// Views that one reference is compared with at most.
  package static let maximumSources = 8

  /// Makes the patches of `map`'s view from its seeds and the source views, the best first.
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

  /// Makes the patches of `map`'s view from those at half the resolution, which the filter has judged
  /// with visibility. `sources` are as they were for them, in the same order.
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

  /// Marks the patches of `map` that enough of its neighbours confirm and no more contradict; `refine`
  /// wants to know which do, too.
  package static func filter(
    _ map: PatchMap, neighbors: [PatchMap], options: FilterOptions, tellsVisibility: Bool = false,
    control: KernelControl
  ) throws {
    if tellsVisibility { map.makeVisibility() }
    var (rawOptions, rawMap) = (options.raw, map.raw)
    let rawNeighbors = neighbors.map(\.raw)
    try withExtendedLifetime(neighbors) {
      try withKernel(control) {
        ck_patches_filter(
          map.states, map.visibility, &rawMap, rawNeighbors, rawNeighbors.count, &rawOptions, $0)
      }
    }
  }

  /// Expands patches across views and into holes: the patches of `map` with better ones, taken from
  /// its neighbours and from those beside them, where the filter rejected them; near edges of the
  /// surface they are made anew, of the texels on their side. Call once the map and all its neighbours
  /// are filtered; the filter has to judge the result anew.
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

  /// Fuses the accepted patches of `map` with those of its neighbours that agree with them.
  ///
  /// Call once the map and all its neighbours are filtered. A piece of surface that several views show
  /// becomes a point of the view that shows it finest, so that maps are fused in any order.
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
      is_frontal: estimatesNormals ? 0 : 1, seed: seed, instructions: instructions.raw)
  }
}

extension PatchStereo.FilterOptions {
  fileprivate var raw: ck_patch_filter_options {
    ck_patch_filter_options(
      photometric_threshold: photometricThreshold,
      weak_texture_threshold: max(photometricThreshold, weakTextureThreshold),
      minimum_agreeing: Int32(minimumAgreeingViews),
      reprojection_threshold: reprojectionThreshold, depth_threshold: depthThreshold,
      normal_cosine: cosine(degrees: normalThresholdDegrees),
      contradiction_threshold: contradictionThreshold, fringe_passes: Int32(fringePasses),
      fringe_contrast: fringeContrast, minimum_island: Int32(minimumIsland),
      fusion_threshold: fusionThreshold, instructions: instructions.raw)
  }
}
