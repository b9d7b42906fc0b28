#include "surface/poisson/solution.h"

#include "core/progress.h"
#include "surface/poisson/density.h"
#include "surface/poisson/solver.h"

namespace ck::poisson {

namespace {

/// Whether a node of a brick is in a box.
bool has_node(const CellBox& box, const Level& level, const Coordinates& brick, int index) {
  Coordinates node = local_coordinates(index);
  for (size_t a = 0; a < 3; ++a) node[a] += kSide * brick[a];
  return box.has_node(node, level.depth);
}

Solution solved(const Solution* base, Samples samples, int depth, size_t maximum_bytes,
                const ck_control* control) {
  // Measured: the shares of the time on boot and orbit.
  const ProgressPart density(control, 0, 0.09), octree(control, 0.09, 0.27),
      solving(control, 0.27, 0.97), averaging(control, 0.97, 1);
  const std::vector<Level> none;
  const std::vector<Level>& known = base ? base->levels : none;
  Solution result;
  result.cube = samples.cube;
  estimate_density(samples, depth, density.control());
  result.levels = make_levels(samples, depth, maximum_bytes, known, octree.control());
  solve(result.levels, samples, known, solving.control());
  result.value = base ? base->value : mean_value(result.levels, samples, averaging.control());
  return result;
}

}  // namespace

Solution solution(Samples samples, int depth, size_t maximum_bytes, const ck_control* control) {
  return solved(nullptr, std::move(samples), depth, maximum_bytes, control);
}

Solution refined(const Solution& base, Samples samples, int depth, const ck_control* control) {
  return solved(&base, std::move(samples), depth, SIZE_MAX, control);
}

void adopt(Solution& part, const Solution& other, size_t shared, const CellBox& box,
           const ck_control* control) {
  for (size_t l = shared; l < std::min(part.levels.size(), other.levels.size()); ++l) {
    Level& level = part.levels[l];
    const Level& source = other.levels[l];
    parallel_for(control, level.bricks.count(), [&](size_t b) {
      const Coordinates brick = level.bricks.coordinates(b);
      if (!box.touches(brick, level.depth)) return;
      const int32_t found = source.bricks.find(brick);
      if (found < 0) return;
      for (int i = 0; i < kBrick; ++i) {
        if (!has_node(box, level, brick, i)) continue;
        level.values[b * kBrick + i] = source.values[found * size_t{kBrick} + i];
      }
    });
  }
}

}  // namespace ck::poisson
