#include "patches/expand.h"

#include <algorithm>

#include "patches/random.h"

namespace ck::patches {
namespace {

/// The work at one pixel: a best plane so far and the means to try others.
class Pixel {
 public:
  Pixel(Grid& grid, const Comparison& c, const Kernels& k, const Sweep& sweep, int x, int y)
      : comparison_(c),
        kernels_(k),
        x_(x),
        y_(y),
        plane_(grid.planes[grid.index(x, y)]),
        score_(grid.scores[grid.index(x, y)]),
        sources_(sweep.uses_kept_sources && score_.best ? score_.best : 0xff) {
    k.prepare(reference_, c, x, y);
    const Plane start = plane_;
    score_.cost = 2;
    if (start.w > 0) offer(start);
  }

  /// Takes the plane if it costs less.
  bool offer(const Plane& plane) {
    if (!is_plausible(comparison_, x_, y_, plane)) return false;
    const Score score = kernels_.score(reference_, comparison_, x_, y_, plane, sources_);
    if (!(score.cost < score_.cost)) return false;
    score_ = score;
    plane_ = plane;
    return true;
  }

  void perturb(int count, uint32_t seed) {
    Random random(seed, static_cast<uint32_t>(x_), static_cast<uint32_t>(y_));
    float range = 1;
    for (int i = 0; i < count; ++i, range *= 0.5f) {
      const float depth = 0.02f * range, slant = 0.7f * range;
      offer({plane_.w * (1 + depth * random.symmetric()),
             plane_.gx + plane_.w * slant / comparison_.fx * random.symmetric(),
             plane_.gy + plane_.w * slant / comparison_.fy * random.symmetric()});
    }
  }

  void refine(int steps) {
    for (int i = 0; i < steps && score_.best; ++i) {
      Plane next;
      if (!kernels_.step(reference_, comparison_, x_, y_, plane_, score_.best, next)) return;
      if (!offer(next)) return;
    }
  }

  bool is_empty() const { return !(plane_.w > 0) || score_.cost >= 2; }

 private:
  const Comparison& comparison_;
  const Kernels& kernels_;
  int x_, y_;
  Plane& plane_;
  Score& score_;
  uint8_t sources_;
  ReferencePatch reference_;
};

}  // namespace

void expand(Grid& grid, const Comparison& comparison, const Kernels& kernels, const Sweep& sweep,
            const ck_control* control, double progress_from, double progress_to) {
  const int rows = grid.height - 2 * kMargin, columns = grid.width - 2 * kMargin;
  const int direction = sweep.is_forward ? -1 : 1;
  for (int row = 0; row < rows; ++row) {
    step(control, progress_from + (progress_to - progress_from) * row / rows);
    const int y = sweep.is_forward ? kMargin + row : grid.height - 1 - kMargin - row;
    for (int column = 0; column < columns; ++column) {
      const int x = sweep.is_forward ? kMargin + column : grid.width - 1 - kMargin - column;
      Pixel pixel(grid, comparison, kernels, sweep, x, y);
      const Plane& beside = grid.planes[grid.index(x + direction, y)];
      const Plane& above = grid.planes[grid.index(x, y + direction)];
      const auto step_back = static_cast<float>(-direction);
      if (beside.w > 0) pixel.offer(beside.at(step_back, 0));
      if (above.w > 0) pixel.offer(above.at(0, step_back));
      if (pixel.is_empty()) continue;
      if (sweep.perturbations > 0) pixel.perturb(sweep.perturbations, sweep.seed);
      if (sweep.refinement_steps > 0) pixel.refine(sweep.refinement_steps);
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
      Plane plane = coarse.planes[parent].at((x + 0.5f) / 2 - (px + 0.5f),
                                             (y + 0.5f) / 2 - (py + 0.5f));
      plane.gx *= 0.5f;
      plane.gy *= 0.5f;
      fine.planes[child] = plane;
      fine.scores[child] = coarse.scores[parent];
    }
  }
  return fine;
}

}  // namespace ck::patches
