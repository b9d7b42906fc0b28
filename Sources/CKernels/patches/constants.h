#pragma once

namespace ck::patches {

// Constants of patch stereo that no option sets, for all levels and views. "Empirical" ones were
// chosen by trial while the method was developed; where BENCHMARKS.md has a measurement, the
// comment says so. A change of any of them changes results.

/// The least cost of a patch of weak texture, 1 − ZNCC: nothing grows from it into holes.
/// Empirical.
constexpr float kWeakCost = 0.4f;

/// Texture whose confidence is lower hardly stands out from noise: 0.95 is a deviation of about
/// three times the noise. Empirical.
constexpr float kDistinctConfidence = 0.95f;

/// Where texture is weak, the patch of the coarser level is kept if it costs less by this.
/// Empirical.
constexpr float kInheritedCostMargin = 0.1f;

/// Slope by which the costs below `kWeakCost` of kept coarser patches are mapped to those above it:
/// 0…0.4 to 0.4…0.5, which is the default photometric threshold of the filter.
constexpr float kWeakCostSlope = 0.25f;

/// Pixels of a source. A proposed plane that moves the texels less is not scored, as Gauss–Newton
/// gets there by itself. Empirical.
constexpr float kSamePlaneMotion = 0.4f;

/// Pixels of a source. A Gauss–Newton step that moves the texels less is not scored again, which
/// costs no accuracy (BENCHMARKS.md, boot at half resolution).
constexpr float kUnverifiedMotion = 0.2f;

/// Range of the first random perturbation of a plane, which is halved in each round: of the inverse
/// depth, relative, and of the slant, as a tangent. Empirical.
constexpr float kPerturbedDepth = 0.02f, kPerturbedSlant = 0.7f;

/// Pixels of a source that one pixel of the reference may cover: in less there is no detail, in
/// more there is aliasing. Empirical.
constexpr float kSmallestFootprint = 0.1f, kLargestFootprint = 8.0f;

/// A source takes part in a Gauss–Newton step if its cost is below `factor · best + offset`: one
/// that sees the patch much worse than the best sees something in front of it. Weights by cost
/// instead gave F 0.962 against 0.966 at 0.5 mm (BENCHMARKS.md, boot at half resolution).
/// Empirical.
constexpr float kVoterFactor = 1.5f, kVoterOffset = 0.05f;

/// Cosine of the largest angle between a patch's normal and its viewing ray: 80°.
constexpr float kGrazingCosine = 0.17f;

/// Cost below which a coarse patch that the filter rejected is refined all the same; where none of
/// those around is accepted or costs less, nothing is tried. Empirical.
constexpr float kPromisingCost = 0.3f;

/// Factors by which the range of inverse depths of the seeds, of coarse patches, and of patches and
/// offers to be completed is extended. Empirical.
constexpr float kSeedRangeMargin = 2.0f, kRefinementRangeMargin = 1.5f,
                kCompletionRangeMargin = 1.1f;

/// Weight of a texel in completion of which it isn't known what surface it shows. Empirical.
constexpr float kUnknownTexelWeight = 0.5f;

/// Cost that a patch's weight in fusion adds, so that near-perfect patches weigh alike. Empirical.
constexpr float kFusionCostOffset = 0.05f;

/// Relative difference of inverse depth between adjacent patches of one island. Empirical.
constexpr float kIslandDepthStep = 0.02f;

/// Cosine below which a patch's footprint isn't enlarged any more by its slant. Empirical.
constexpr float kLeastFootprintCosine = 0.1f;

}  // namespace ck::patches
