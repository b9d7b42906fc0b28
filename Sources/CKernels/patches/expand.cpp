#include "patches/expand.h"

#include <algorithm>

#include "patches/optimize.h"

namespace ck::patches {

void expand(Grid& grid, const Comparison& comparison, const Kernels& kernels, const Sweep& sweep,
            const ck_control* control, double progress_from, double progress_to) {
  PatchOptimizer optimizer(grid, comparison, kernels);
  const Wavefront wavefront(grid.width, grid.height, sweep.is_forward);
  const int back = sweep.is_forward ? -1 : 1;
  wavefront.run(control, progress_from, progress_to, [&](Cell* cells, int count) {
    const auto end = std::remove_if(cells, cells + count, [&](const Cell& cell) {
      return !grid.sources[grid.index(cell.x, cell.y)];
    });
    optimizer.start(cells, static_cast<int>(end - cells));
    optimizer.test_distinct([&](const Cell& cell) { return grid.plane_from(cell, back, 0); });
    optimizer.test_distinct([&](const Cell& cell) { return grid.plane_from(cell, 0, back); });
    optimizer.perturb(sweep.perturbations, sweep.seed);
    optimizer.refine(sweep.refinement_steps, false);
    if (sweep.may_inherit) optimizer.revert_to_coarse_if_weak();
    optimizer.finish();
  });
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
