#include "surface/poisson/samples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/guard.h"
#include "core/parallel_sort.h"

namespace ck::poisson {

namespace {

/// Number of samples that a thread works on at a time. Chosen: less than a millisecond.
constexpr size_t kBlock = 1 << 14;

double length(const float* v) { return std::hypot(v[0], v[1], v[2]); }

}  // namespace

Samples::Samples(const Strided<float>& p, const Strided<float>& n, double scale, const Cube& given,
                 const ck_control* control) {
  const ck_control quiet{nullptr, nullptr, thread_count(control)};
  std::vector<char> is_used(p.count);
  parallel_for_blocks(&quiet, p.count, kBlock, [&](size_t i) {
    is_used[i] = p.is_finite(i) && n.is_finite(i) && length(n[i]) > 0;
  });
  std::vector<size_t> used;
  used.reserve(p.count);
  for (size_t i = 0; i < p.count; ++i) {
    if (is_used[i]) used.push_back(i);
  }
  samples.resize(used.size());
  parallel_for_blocks(&quiet, used.size(), kBlock, [&](size_t k) {
    const size_t i = used[k];
    const double of_normal = length(n[i]);
    for (size_t a = 0; a < 3; ++a) {
      samples[k].position[a] = p[i][a];
      samples[k].normal[a] = static_cast<float>(n[i][a] / of_normal);
    }
  });
  if (given.side > 0) {
    cube = given;
    remove_outside();
  }
  if (samples.size() < 4) throw Degenerate("fewer than four oriented points");
  if (!(given.side > 0)) cube = cube_around(scale);
  parallel_for_blocks(&quiet, samples.size(), kBlock, [&](size_t i) { move_to_cube(samples[i]); });
  sort(&quiet);
}

Cube Samples::cube_around(double scale) const {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Sample& s : samples) {
    for (size_t a = 0; a < 3; ++a) {
      low[a] = std::min<double>(low[a], s.position[a]);
      high[a] = std::max<double>(high[a], s.position[a]);
    }
  }
  Cube result;
  for (size_t a = 0; a < 3; ++a) result.side = std::max(result.side, scale * (high[a] - low[a]));
  if (!(result.side > 0)) throw Degenerate("all points are at one position");
  for (size_t a = 0; a < 3; ++a) result.origin[a] = (low[a] + high[a]) / 2 - result.side / 2;
  return result;
}

void Samples::remove_outside() {
  const auto is_outside = [&](const Sample& s) {
    for (size_t a = 0; a < 3; ++a) {
      const double at = (s.position[a] - cube.origin[a]) / cube.side;
      if (!(at >= 0 && at < 1)) return true;
    }
    return false;
  };
  samples.erase(std::remove_if(samples.begin(), samples.end(), is_outside), samples.end());
}

/// Samples of one cell stay in the order of the input.
void Samples::sort(const ck_control* control) {
  struct Place {
    uint64_t code;
    size_t index;
  };
  Uninitialized<Place> order(samples.size());
  parallel_for_blocks(control, order.size(), kBlock, [&](size_t i) {
    order[i] = {samples[i].code, i};
  });
  const auto is_before = [](const Place& a, const Place& b) {
    return a.code != b.code ? a.code < b.code : a.index < b.index;
  };
  parallel_sort(order, is_before, control);
  Uninitialized<Sample> sorted(samples.size());
  parallel_for_blocks(control, order.size(), kBlock,
                      [&](size_t i) { sorted[i] = samples[order[i].index]; });
  samples = std::move(sorted);
}

void Samples::move_to_cube(Sample& s) const {
  const float largest = std::nextafter(1.0f, 0.0f);
  Coordinates cell;
  for (size_t a = 0; a < 3; ++a) {
    const double at = (static_cast<double>(s.position[a]) - cube.origin[a]) / cube.side;
    s.position[a] = std::clamp(static_cast<float>(at), 0.0f, largest);
    cell[a] = static_cast<int>(std::ldexp(s.position[a], kCodeDepth));
  }
  s.code = morton(cell);
}

std::pair<size_t, size_t> Samples::range(uint64_t brick_code, int depth) const {
  // Above depth 3 a brick is a cell of the level three above; below, it is the cube.
  const int brick_depth = std::max(0, depth - 3), shift = 3 * (kCodeDepth - brick_depth);
  // Nodes at the far sides of the cube are in bricks without cells.
  if (brick_code >> 3 * brick_depth != 0) return {0, 0};
  const auto before = [](const Sample& s, uint64_t code) { return s.code < code; };
  const auto first = std::lower_bound(samples.begin(), samples.end(), brick_code << shift, before);
  const auto last = std::lower_bound(first, samples.end(), (brick_code + 1) << shift, before);
  return {first - samples.begin(), last - samples.begin()};
}

}  // namespace ck::poisson
