#include "patches/optimise.h"

#include <cmath>

#include "core/random.h"

namespace ck::patches {

PatchOptimiser::PatchOptimiser(Grid& grid, const Comparison& comparison, const Kernels& kernels,
                               int x, int y)
    : comparison_(comparison),
      kernels_(kernels),
      x_(x),
      y_(y),
      plane_(grid.planes[grid.index(x, y)]),
      cost_(grid.costs[grid.index(x, y)]),
      sources_(grid.sources[grid.index(x, y)]),
      inherited_{plane_, cost_} {
  kernels.prepare(reference_, comparison, x, y);
  cost_ = kNoPatch;
  if (inherited_.plane.w > 0) offer(inherited_.plane);
}

bool PatchOptimiser::offer(const Plane& offered) {
  const Plane plane = comparison_.is_frontal ? Plane{offered.w, 0, 0} : offered;
  if (!is_plausible(comparison_, x_, y_, plane)) return false;
  Samples& samples = samples_[1 - current_];
  const float cost = kernels_.score(reference_, comparison_, x_, y_, plane, sources_, samples);
  if (!(cost < cost_)) return false;
  cost_ = cost;
  plane_ = plane;
  current_ = 1 - current_;
  return true;
}

float PatchOptimiser::motion_to(const Plane& plane) const {
  constexpr float kReach = 2;  // the patch's outermost texels
  const float slope = std::fabs(plane.gx - plane_.gx) + std::fabs(plane.gy - plane_.gy);
  return (std::fabs(plane.w - plane_.w) + kReach * slope) * comparison_.motion;
}

bool PatchOptimiser::offer_different(const Plane& plane) {
  constexpr float kSame = 0.4f;  // Gauss–Newton gets there by itself.
  return (is_empty() || motion_to(plane) > kSame) && offer(plane);
}

void PatchOptimiser::settle() {
  constexpr float kDistinct = 0.95f;  // deviation over noise of about 3
  constexpr float kMargin = 0.1f;
  const bool is_weak = reference_.confidence < kDistinct;
  if (inherited_.plane.w > 0 && is_weak && inherited_.cost + kMargin < cost_) {
    plane_ = inherited_.plane;
    cost_ = inherited_.cost;
    if (cost_ < kWeakCost) cost_ = kWeakCost + 0.25f * cost_;
  }
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
  constexpr float kClose = 0.2f;  // So near the optimum a step need not be verified.
  for (int i = 0; i < steps && samples_[current_].voters; ++i) {
    Plane next;
    if (!kernels_.step(reference_, samples_[current_], plane_, next)) return;
    if (comparison_.is_frontal) next = {next.w, 0, 0};
    if (motion_to(next) < kClose) {
      if (is_plausible(comparison_, x_, y_, next)) plane_ = next;
      return;
    }
    if (!offer(next)) return;
  }
}

}  // namespace ck::patches
