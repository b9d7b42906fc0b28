#pragma once

#include "core/guard.h"
#include "patches/grid.h"

namespace ck::patches {

/// What a propagation sweep does at each pixel in addition to testing its neighbors' planes.
struct Sweep {
  /// True: from top left to bottom right; false: the reverse.
  bool is_forward = true;
  /// Number of random perturbations of the current plane to test.
  int perturbations = 0;
  /// Number of Gauss–Newton steps.
  int refinement_steps = 0;
  /// The grid holds patches of a coarser level, which are kept where they are better.
  bool may_inherit = false;
  /// Seed of the perturbations.
  uint32_t seed = 0;
};

/// Propagates patches over the grid: each pixel tests the planes of the two neighbors that the
/// sweep has visited, and optimizes the best one.
void expand(Grid& grid, const Comparison& comparison, const Kernels& kernels, const Sweep& sweep,
            const ck_control* control, double progress_from, double progress_to);

/// Upsamples the patches of a coarser level to twice the resolution; the result is not scored.
Grid refine_grid(const Grid& coarse, int width, int height);

}  // namespace ck::patches
