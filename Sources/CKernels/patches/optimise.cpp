#include "patches/optimise.h"

#include "core/random.h"

namespace ck::patches {

PatchOptimiser::PatchOptimiser(Grid& grid, const Comparison& comparison, const Kernels& kernels,
                               int x, int y, uint8_t sources)
    : comparison_(comparison),
      kernels_(kernels),
      x_(x),
      y_(y),
      plane_(grid.planes[grid.index(x, y)]),
      score_(grid.scores[grid.index(x, y)]),
      sources_(sources) {
  kernels.prepare(reference_, comparison, x, y);
  const Plane start = plane_;
  score_ = Score();
  if (start.w > 0) offer(start);
}

bool PatchOptimiser::offer(const Plane& plane) {
  if (!is_plausible(comparison_, x_, y_, plane)) return false;
  Samples& samples = samples_[1 - current_];
  const Score score = kernels_.score(reference_, comparison_, x_, y_, plane, sources_, samples);
  if (!(score.cost < score_.cost)) return false;
  score_ = score;
  plane_ = plane;
  current_ = 1 - current_;
  return true;
}

void PatchOptimiser::perturb(int count, uint32_t seed) {
  const uint64_t place = uint64_t{static_cast<uint32_t>(y_)} << 32 | static_cast<uint32_t>(x_);
  Random random(Random::mixed(seed) ^ place);
  float range = 1;
  for (int i = 0; i < count; ++i, range *= 0.5f) {
    const float depth = 0.02f * range, slant = 0.7f * range;
    offer({plane_.w * (1 + depth * random.symmetric()),
           plane_.gx + plane_.w * slant / comparison_.fx * random.symmetric(),
           plane_.gy + plane_.w * slant / comparison_.fy * random.symmetric()});
  }
}

void PatchOptimiser::refine(int steps) {
  for (int i = 0; i < steps && score_.best; ++i) {
    Plane next;
    if (!kernels_.step(reference_, samples_[current_], plane_, score_.best, next)) return;
    if (!offer(next)) return;
  }
}

}  // namespace ck::patches
