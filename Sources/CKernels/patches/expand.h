#pragma once

#include "core/guard.h"
#include "patches/grid.h"

namespace ck::patches {

/// What a sweep does at each pixel besides trying its neighbours' planes.
struct Sweep {
  /// From the top left to the bottom right, or back.
  bool is_forward = true;
  /// Random planes tried around the current one.
  int perturbations = 0;
  /// Gauss–Newton steps.
  int refinement_steps = 0;
  /// The grid holds a coarser level's patches, to be kept where they are better.
  bool may_inherit = false;
  uint32_t seed = 0;
};

/// Expands patches over the grid: each pixel tries the planes of the two neighbours that the sweep
/// has passed, and optimises what it keeps.
void expand(Grid& grid, const Comparison& comparison, const Kernels& kernels, const Sweep& sweep,
            const ck_control* control, double progress_from, double progress_to);

/// The patches of the next finer level, offered by the coarser one; not scored.
Grid refine_grid(const Grid& coarse, int width, int height);

}  // namespace ck::patches
