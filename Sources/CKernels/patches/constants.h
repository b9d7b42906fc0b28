#pragma once

namespace ck::patches {

// Constants of patch stereo that are not options, the same for all levels and views. Changing any
// of them changes results.

/// Lower bound of the cost (1 − ZNCC) of a weakly textured patch; patches of this cost are not
/// propagated into holes. Chosen: by trial.
constexpr float kWeakCost = 0.4f;

/// Texture with a lower confidence is close to the noise level: 0.95 is a standard deviation of
/// about three times the noise. Chosen: by trial.
constexpr float kDistinctConfidence = 0.95f;

/// Where texture is weak, the patch of the coarser level is kept if its cost is lower by this
/// margin. Chosen: by trial.
constexpr float kInheritedCostMargin = 0.1f;

/// Slope by which the costs below `kWeakCost` of kept coarser patches are mapped to those above it:
/// 0…0.4 to 0.4…0.5. Limit: the default photometric threshold of the filter is 0.5.
constexpr float kWeakCostSlope = 0.25f;

/// In pixels of a source. A proposed plane that moves the texels by less is not scored, because
/// Gauss–Newton converges to it anyway. Measured: 1.36 instead of 2.26 CPU seconds per megapixel,
/// together with scoring four sources at a time (BENCHMARKS.md of `a00f5c5`).
constexpr float kSamePlaneMotion = 0.4f;

/// In pixels of a source. After a Gauss–Newton step that moves the texels by less, the plane is not
/// scored again. Measured: no loss of accuracy on boot at half resolution
/// (docs/experiments/2026-11-dense-stage.md, "Experiments").
constexpr float kUnverifiedMotion = 0.2f;

/// Range of the first random perturbation of a plane, which is halved in each round: relative for
/// the inverse depth, as a tangent for the slant. Chosen: by trial.
constexpr float kPerturbedDepth = 0.02f, kPerturbedSlant = 0.7f;

/// Bounds of the area of a reference pixel in pixels of a source: smaller areas contain no detail,
/// larger ones cause aliasing. Chosen: by trial.
constexpr float kMinimumFootprint = 0.1f, kMaximumFootprint = 8.0f;

/// A source takes part in a Gauss–Newton step if its cost is below `factor · best + offset`: a
/// source with a much higher cost than the best one is occluded. Measured: the rule raises the
/// share of pixels within 0.5 mm from 0.939 to 0.944 on four views of boot (BENCHMARKS.md of
/// `a00f5c5`); weights by cost instead lower F from 0.966 to 0.962 on boot
/// (docs/experiments/2026-11-dense-stage.md, "Experiments"). The numbers were chosen by trial.
constexpr float kVisibleCostFactor = 1.5f, kVisibleCostOffset = 0.05f;

/// Cosine of the largest angle between a patch's normal and its viewing ray: 80°. Chosen.
constexpr float kGrazingCosine = 0.17f;

/// Cost below which a coarse patch is refined although the filter rejected it. A cell is skipped if
/// none of the surrounding coarse patches is accepted or has a lower cost. Chosen: by trial.
constexpr float kPromisingCost = 0.3f;

/// Factors by which the range of inverse depths is extended: that of the seeds, of the coarse
/// patches, and, for completion, of the patches and their proposals. Chosen: by trial.
constexpr float kSeedRangeMargin = 2.0f, kRefinementRangeMargin = 1.5f,
                kCompletionRangeMargin = 1.1f;

/// Weight in completion of a texel whose surface is unknown. Chosen: by trial.
constexpr float kUnknownTexelWeight = 0.5f;

/// Offset added to the cost of a patch for its weight in fusion, so that near-perfect patches have
/// similar weights. Chosen: by trial.
constexpr float kFusionCostOffset = 0.05f;

/// Largest relative difference of inverse depth between adjacent patches of one connected
/// component. Chosen: by trial.
constexpr float kIslandDepthStep = 0.02f;

/// Lower bound of the cosine in the footprint of a slanted patch. Chosen: by trial.
constexpr float kMinimumFootprintCosine = 0.1f;

/// Smallest third coordinate of a projected patch, relative to its depth in the reference. Limit:
/// rounding in single precision.
constexpr float kMinimumProjection = 1e-6f;

/// Smallest slope of one view's plane along another's ray, which is 0 where they are parallel.
/// Chosen.
constexpr float kMinimumRaySlope = 1e-3f;

}  // namespace ck::patches
