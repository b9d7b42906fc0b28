#include "patches/expand.h"

#include <algorithm>

#include "patches/optimise.h"

namespace ck::patches {

void expand(Grid& grid, const Comparison& comparison, const Kernels& kernels, const Sweep& sweep,
            const ck_control* control, double progress_from, double progress_to) {
  const int rows = grid.height - 2 * kMargin, columns = grid.width - 2 * kMargin;
  const int direction = sweep.is_forward ? -1 : 1;
  for (int row = 0; row < rows; ++row) {
    step(control, progress_from + (progress_to - progress_from) * row / rows);
    const int y = sweep.is_forward ? kMargin + row : grid.height - 1 - kMargin - row;
    for (int column = 0; column < columns; ++column) {
      const int x = sweep.is_forward ? kMargin + column : grid.width - 1 - kMargin - column;
      if (!grid.sources[grid.index(x, y)]) continue;
      PatchOptimiser pixel(grid, comparison, kernels, x, y);
      const Plane& beside = grid.planes[grid.index(x + direction, y)];
      const Plane& above = grid.planes[grid.index(x, y + direction)];
      const auto step_back = static_cast<float>(-direction);
      if (beside.w > 0) pixel.offer_different(beside.at(step_back, 0));
      if (above.w > 0) pixel.offer_different(above.at(0, step_back));
      if (!pixel.is_empty()) {
        pixel.perturb(sweep.perturbations, sweep.seed);
        pixel.refine(sweep.refinement_steps);
      }
      if (sweep.may_inherit) pixel.settle();
    }
  }
}

Grid refine_grid(const Grid& coarse, int width, int height) {
  Grid fine(width, height);
  for (int y = 0; y < height; ++y) {
    const int py = std::min(y / 2, coarse.height - 1);
    for (int x = 0; x < width; ++x) {
      const int px = std::min(x / 2, coarse.width - 1);
      const size_t parent = coarse.index(px, py), child = fine.index(x, y);
      if (!(coarse.planes[parent].w > 0)) continue;
      Plane plane =
          coarse.planes[parent].at((x + 0.5f) / 2 - (px + 0.5f), (y + 0.5f) / 2 - (py + 0.5f));
      plane.gx *= 0.5f;
      plane.gy *= 0.5f;
      fine.planes[child] = plane;
      fine.costs[child] = coarse.costs[parent];
    }
  }
  return fine;
}

}  // namespace ck::patches
