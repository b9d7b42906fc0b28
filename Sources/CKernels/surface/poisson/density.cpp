#include "surface/poisson/density.h"

#include <algorithm>
#include <cmath>

#include "surface/poisson/field.h"

namespace ck::poisson {

namespace {

/// Number of samples, weighted by the kernel, from which on their density is known well enough.
/// Chosen: that of about seven.
constexpr double kSufficientCount = 4;
/// The count at a point of a plane with one sample per cell. Limit: the mean over the distances of
/// the plane from the nodes, for planes along an axis, is 0.599.
constexpr double kPlaneCount = 0.6;
/// Cells with this many samples resolve them. Chosen: the default of Kazhdan and Hoppe's program.
constexpr double kSamplesPerCell = 1.5;
/// The coarsest level by which density is estimated. Chosen: 8 cells per axis.
constexpr int kCoarsestDensity = 3;

/// The bricks of the nodes that the samples' weights reach.
BrickSet reached_bricks(const Samples& samples, int depth, const ck_control* control) {
  const int side = 1 << depth;
  const auto codes = samples.map_blocks(control, [&](size_t first, size_t last) {
    BrickCodes part;
    samples.for_cells(first, last, depth, 0,
                      [&](const Coordinates& cell) { part.add(cell, 1, 2, side); });
    return part.take();
  });
  return BrickSet(merged(codes), control);
}

/// By the density of one level; returns whether samples are left for which it is too fine.
bool estimate_density(Samples& samples, int level, int depth, const ck_control* control) {
  const BrickSet bricks = reached_bricks(samples, level, control);
  Field<1> counts(bricks);
  splat(counts, bricks, samples, level, control,
        [](const Sample&) { return std::array<float, 1>{1}; });
  const int cells = 1 << level;
  const double least = level > kCoarsestDensity ? kSufficientCount : 0;
  std::vector<char> is_sparse(bricks.count(), 0);
  parallel_for(control, bricks.count(), [&](size_t b) {
    const auto [first, last] = samples.range(bricks.code(b), level);
    for (size_t i = first; i < last; ++i) {
      Sample& s = samples.samples[i];
      if (s.area > 0) continue;
      const CellPosition at(s.position, bricks.coordinates(b), cells);
      const double count = interpolate(counts.values, bricks, b, at);
      if (count < least) {
        is_sparse[b] = 1;
        continue;
      }
      const double per_cell = std::max(count, 1e-3) / kPlaneCount;
      s.area = static_cast<float>(1 / (per_cell * cells * cells));
      // A cell of the next level has a quarter of the samples.
      const double exact = level + std::log2(per_cell / kSamplesPerCell) / 2;
      s.depth = static_cast<float>(std::clamp<double>(exact, 0, depth));
    }
  });
  return std::any_of(is_sparse.begin(), is_sparse.end(), [](char is) { return is != 0; });
}

}  // namespace

void estimate_density(Samples& samples, int depth, const ck_control* control) {
  for (Sample& s : samples.samples) s.area = 0;
  // Few samples are left for coarse levels: each is given half of the remaining progress.
  double done = 0;
  for (int level = std::max(depth - 1, kCoarsestDensity); level >= kCoarsestDensity; --level) {
    const ProgressPart part(control, done, (1 + done) / 2);
    if (!estimate_density(samples, level, depth, part.control())) return;
    done = (1 + done) / 2;
  }
}

}  // namespace ck::poisson
