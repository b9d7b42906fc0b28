import Kernels

extension PointCloudGeneration {
  /// Parameters of the dense stage.
  package struct Options: Hashable, Codable, Sendable {
    /// Pixels of a view at full resolution. Chosen: `PipelineConfiguration` sets that of the detail
    /// level.
    package var maximumPixelsPerView = 1_000_000
    var sourceSelection = SourceSelection.Options()
    /// Blurred photos with less than this share of a view's detail contribute no patches: their
    /// poses are as imprecise as their pixels, and their points spoil those of sharp photos.
    /// Measured: on boot with six of 40 photos blurred (docs/experiments/2026-11-masks.md, Blur,
    /// concerns and sky).
    var minimumDetail = 0.5
    /// Optimization of the patches, at all resolutions.
    package var patches = PatchStereo.Options()
    /// Filter of the patches at full resolution.
    package var filter = PatchStereo.FilterOptions()
    /// For the patches at half resolution, where smaller islands may still grow. Chosen.
    package var coarseFilter = PatchStereo.FilterOptions(minimumIsland: 10)
    /// Whether patches expand into what the filter rejected, and are re-estimated at depth edges.
    package var completes = true
    /// Share of the photos' pixels below which a warning calls the cloud sparse. Chosen.
    package var sparseRatio = 0.05
    /// Points of the cloud, at most; more are thinned. `Machine.limits` sets that of the machine.
    /// Chosen: more than any memory holds.
    package var maximumPoints = 1 << 40
    /// Size in bytes of the cache of views and patch maps that are not in use. Chosen.
    package var cacheBytes = 512 << 20

    package init(maximumPixelsPerView: Int = 1_000_000) {
      self.maximumPixelsPerView = maximumPixelsPerView
    }
  }
}
