#include <algorithm>
#include <cmath>

#include "core/guard.h"
#include "patches/comparison.h"
#include "patches/expand.h"
#include "patches/seed.h"
#include "patches/smooth.h"

namespace ck::patches {
namespace {

/// Approximate side in pixels that the coarsest level has at least. Chosen.
constexpr int kMinimumLevelSide = 32;

/// The number of pyramid levels, such that the coarsest one is not too small.
int level_count(const ck_patch_view& reference, const ck_patch_view* sources, size_t count,
                int requested) {
  int side = std::min(reference.camera.width, reference.camera.height);
  for (size_t i = 0; i < count; ++i) {
    side = std::min({side, sources[i].camera.width, sources[i].camera.height});
  }
  int levels = 1;
  while (levels < requested && (side >> levels) >= kMinimumLevelSide) ++levels;
  return levels;
}

/// Seeds, propagates and optimizes patches, coarse to fine.
Grid reconstruct(const ck_patch_view& reference, const ck_patch_view* sources, size_t count,
                 const ck_patch_seed* seeds, size_t seed_count, const ck_patch_options& options,
                 const ck_control* control) {
  const int levels = level_count(reference, sources, count, options.level_count);
  const Pyramids pyramids(reference, sources, count, levels);
  InverseDepthRange range;
  for (size_t i = 0; i < seed_count; ++i) range.include(seeds[i].inverse_depth);
  if (range.is_empty()) throw Degenerate("the view has no sparse points to start from");
  Grid grid;
  double progress = 0;
  for (int level = levels - 1; level >= 0; --level) {
    const Comparison comparison = pyramids.compare(level, range, kSeedRangeMargin, options);
    const bool is_coarsest = level == levels - 1;
    if (is_coarsest) {
      grid = Grid(comparison.width, comparison.height);
      seed(grid, comparison, seeds, seed_count, 1.0 / (1 << level));
    } else {
      grid = refine_grid(grid, comparison.width, comparison.height);
    }
    const double end = level == 0 ? 1.0 : progress + (1 - progress) * 0.3;
    const int sweeps = is_coarsest ? std::max(1, options.coarse_sweeps) : 1;
    for (int i = 0; i < sweeps; ++i) {
      Sweep sweep;
      sweep.is_forward = (level + i) % 2 == 0;
      sweep.perturbations = is_coarsest ? options.perturbations : 0;
      sweep.refinement_steps = options.refinement_steps;
      sweep.may_inherit = !is_coarsest;
      sweep.seed = options.seed + static_cast<uint32_t>(16 * level + i);
      expand(grid, comparison, kernels(options.instructions), sweep, control,
             progress + (end - progress) * i / sweeps,
             progress + (end - progress) * (i + 1) / sweeps);
    }
    progress = end;
    if (level == 0) smooth(grid, comparison);
  }
  return grid;
}

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_reconstruct(const ck_patch_view* reference, const ck_patch_view* sources,
                                 size_t source_count, const ck_patch_seed* seeds, size_t seed_count,
                                 const ck_patch_options* options, const ck_control* control,
                                 ck_patch* patches) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(patches && reference && sources && options, "missing argument");
    check_views(*reference, source_count);
    reconstruct(*reference, sources, source_count, seeds, seed_count, *options, control)
        .write(patches);
  });
}
