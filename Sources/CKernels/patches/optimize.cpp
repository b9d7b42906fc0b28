#include "patches/optimize.h"

#include <cmath>

#include "core/random.h"

namespace ck::patches {

float PatchOptimizer::motion(const Plane& from, const Plane& to) const {
  constexpr float kReach = 2;  // Limit: offset of the patch's outermost texels, in pixels.
  const float slope = std::fabs(to.gx - from.gx) + std::fabs(to.gy - from.gy);
  return (std::fabs(to.w - from.w) + kReach * slope) * comparison_.motion;
}

void PatchOptimizer::add(Trials& trials, int i, const Plane& proposed) {
  Candidate& pixel = pixels_[i];
  const Plane plane = comparison_.is_fronto_parallel ? Plane{proposed.w, 0, 0} : proposed;
  const int n = trials.count;
  trials.trials[n] = {
      &pixel.reference, &pixel.samples[1 - pixel.current], plane, pixel.cell, pixel.sources,
      kNoPatch};
  trials.pixels[n] = i;
  trials.count += is_plausible(comparison_, pixel.cell.x, pixel.cell.y, plane);
}

void PatchOptimizer::start(const Cell* cells, int count) {
  Plane planes[kWaveSize];
  for (int i = 0; i < count; ++i) planes[i] = grid_.planes[grid_.index(cells[i].x, cells[i].y)];
  start(cells, planes, nullptr, count);
}

void PatchOptimizer::start(const Cell* cells, const Plane* planes, const float (*support)[kTexels],
                           int count) {
  count_ = count;
  Trials trials;
  for (int i = 0; i < count; ++i) {
    const size_t cell = grid_.index(cells[i].x, cells[i].y);
    Candidate& pixel = pixels_[i];
    pixel.cell = cells[i];
    pixel.plane = planes[i];
    pixel.cost = kNoPatch;
    pixel.sources = grid_.sources[cell];
    pixel.inherited = {grid_.planes[cell], grid_.costs[cell]};
    pixel.current = 0;
    pixel.samples[0].visible_slots = 0;
    kernels_.prepare(pixel.reference, comparison_, cells[i], support ? support[i] : nullptr);
    add(trials, i, pixel.plane);
  }
  run(trials);
  for (int i = 0; i < count; ++i) pixels_[i].is_new = false;
}

void PatchOptimizer::run(Trials& trials) {
  kernels_.score(comparison_, trials.trials, trials.count);
  int taken = 0;
  for (int n = 0; n < trials.count; ++n) {
    const Trial& trial = trials.trials[n];
    Candidate& pixel = pixels_[trials.pixels[n]];
    const bool is_better = trial.cost < pixel.cost;
    pixel.cost = is_better ? trial.cost : pixel.cost;
    pixel.plane.w = is_better ? trial.plane.w : pixel.plane.w;
    pixel.plane.gx = is_better ? trial.plane.gx : pixel.plane.gx;
    pixel.plane.gy = is_better ? trial.plane.gy : pixel.plane.gy;
    pixel.current ^= is_better;
    pixel.is_new |= is_better;
    trials.pixels[taken] = trials.pixels[n];
    taken += is_better;
  }
  trials.count = taken;
}

void PatchOptimizer::test_each(const Plane* planes) {
  Trials trials;
  for (int i = 0; i < count_; ++i) {
    const Candidate& pixel = pixels_[i];
    if (pixel.is_empty() || motion(pixel.plane, planes[i]) > kSamePlaneMotion)
      add(trials, i, planes[i]);
  }
  run(trials);
}

void PatchOptimizer::revert_to_coarse_if_weak() {
  for (int i = 0; i < count_; ++i) {
    Candidate& pixel = pixels_[i];
    const auto& inherited = pixel.inherited;
    const bool is_weak = pixel.reference.confidence < kDistinctConfidence;
    if (inherited.plane.w > 0 && is_weak && inherited.cost + kInheritedCostMargin < pixel.cost) {
      pixel.plane = inherited.plane;
      pixel.cost = inherited.cost;
      if (pixel.cost < kWeakCost) pixel.cost = kWeakCost + kWeakCostSlope * pixel.cost;
    }
  }
}

void PatchOptimizer::finish() {
  for (const Candidate& pixel : *this) {
    const size_t cell = grid_.index(pixel.cell.x, pixel.cell.y);
    grid_.planes[cell] = pixel.plane;
    grid_.costs[cell] = pixel.cost;
  }
}

void PatchOptimizer::perturb(int count, uint32_t seed) {
  for (int i = 0; i < count_; ++i) {
    const Cell& cell = pixels_[i].cell;
    const uint64_t place =
        uint64_t{static_cast<uint32_t>(cell.y)} << 32 | static_cast<uint32_t>(cell.x);
    pixels_[i].random = Random(Random::mixed(seed) ^ place);
  }
  float range = 1;
  for (int round = 0; round < count; ++round, range *= 0.5f) {
    const float depth = kPerturbedDepth * range, slant = kPerturbedSlant * range;
    Trials trials;
    for (int i = 0; i < count_; ++i) {
      if (pixels_[i].is_empty()) continue;
      const Plane& plane = pixels_[i].plane;
      Random& random = pixels_[i].random;
      add(trials, i,
          {plane.w * (1 + depth * random.symmetric()),
           plane.gx + plane.w * slant / comparison_.fx * random.symmetric(),
           plane.gy + plane.w * slant / comparison_.fy * random.symmetric()});
    }
    run(trials);
  }
}

void PatchOptimizer::refine(int steps, bool only_new) {
  Trials moving;
  for (int i = 0; i < count_; ++i) {
    if (pixels_[i].is_new || !only_new) moving.pixels[moving.count++] = i;
  }
  for (int round = 0; round < steps && moving.count > 0; ++round) {
    Trials trials;
    Plane next[kWaveSize];
    bool is_determined[kWaveSize];
    for (int n = 0; n < moving.count; ++n) {
      const Candidate& pixel = pixels_[moving.pixels[n]];
      const Samples& samples = pixel.samples[pixel.current];
      is_determined[n] =
          samples.visible_slots && kernels_.step(pixel.reference, samples, pixel.plane, next[n]);
    }
    for (int n = 0; n < moving.count; ++n) {
      if (!is_determined[n]) continue;
      Candidate& pixel = pixels_[moving.pixels[n]];
      if (comparison_.is_fronto_parallel) next[n] = {next[n].w, 0, 0};
      if (motion(pixel.plane, next[n]) >= kUnverifiedMotion) {
        add(trials, moving.pixels[n], next[n]);
      } else if (is_plausible(comparison_, pixel.cell.x, pixel.cell.y, next[n])) {
        pixel.plane = next[n];
      }
    }
    run(trials);
    moving = trials;
  }
}

}  // namespace ck::patches
