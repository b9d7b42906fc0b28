#include "surface/poisson/solver.h"

#include "surface/poisson/field.h"
#include "surface/poisson/relaxation.h"
#include "surface/poisson/right_hand_side.h"
#include "surface/poisson/transfer.h"

namespace ck::poisson {

namespace {

/// Number of sweeps of a level: the default of Kazhdan and Hoppe's program. Measured: F of orbit is
/// the same with 20.
constexpr int kSweeps = 8;
/// Number of sweeps of the levels with all cells. Chosen: these are small.
constexpr int kFullSweeps = 60;

/// The values of the level above at the nodes of a level.
void start_from(const Level& above, Level& level, const ck_control* control) {
  parallel_for(control, level.bricks.count(), [&](size_t b) {
    prolong(parent_values(above, level, b, above.values.data(), kBrick),
            level.values.data() + b * kBrick);
  });
}

/// Takes the values of bricks that a base has, too.
void take_values(const Level& base, Level& level, const ck_control* control) {
  parallel_for(control, level.bricks.count(), [&](size_t b) {
    const int32_t other = base.bricks.find(level.bricks.coordinates(b));
    if (other < 0) return;
    const auto first = base.values.begin() + other * std::ptrdiff_t{kBrick};
    std::copy(first, first + kBrick, level.values.begin() + b * std::ptrdiff_t{kBrick});
  });
}

/// The value at a sample in the finest cell that contains it.
double value_at(const Sample& sample, const std::vector<Level>& levels) {
  for (size_t l = levels.size(); l-- > 0;) {
    const Level& level = levels[l];
    const Coordinates cell = from_morton(level.cell_code(sample));
    const Coordinates brick{cell[0] / kSide, cell[1] / kSide, cell[2] / kSide};
    const int32_t b = level.bricks.find(brick);
    if (b < 0 || !level.cells[b][local_index(cell)]) continue;
    const CellPosition at(sample.position, brick, level.side());
    return interpolate(level.values, level.bricks, b, at);
  }
  return 0;
}

}  // namespace

void solve(std::vector<Level>& levels, const Samples& samples, const std::vector<Level>& base,
           const ck_control* control) {
  const ProgressPart first(control, 0, 0.4), second(control, 0.4, 1);
  make_right_hand_sides(levels, samples, first.control());
  double all = 0, done = 0;
  for (const Level& level : levels) all += static_cast<double>(level.bricks.count());
  for (size_t l = 0; l < levels.size(); ++l) {
    Level& level = levels[l];
    const double count = static_cast<double>(level.bricks.count());
    const ProgressPart part(second.control(), done / all, (done + count) / all);
    level.values.assign(level.bricks.count() * kBrick, 0);
    if (l > 0) start_from(levels[l - 1], level, part.control());
    if (l < base.size()) {
      take_values(base[l], level, part.control());
    } else {
      relax(level, level.depth <= kFullDepth ? kFullSweeps : kSweeps, part.control());
    }
    level.rhs = {};
    done += count;
  }
}

double mean_value(const std::vector<Level>& levels, const Samples& samples,
                  const ck_control* control) {
  constexpr size_t kBlock = 1 << 14;  // Samples that a thread works on at a time. Chosen.
  const size_t count = samples.samples.size(), blocks = (count + kBlock - 1) / kBlock;
  std::vector<std::array<double, 2>> sums(blocks, {0, 0});
  parallel_for(control, blocks, [&](size_t block) {
    for (size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
      const Sample& s = samples.samples[i];
      sums[block][0] += s.area * value_at(s, levels);
      sums[block][1] += s.area;
    }
  });
  double sum = 0, area = 0;
  for (const auto& part : sums) {
    sum += part[0];
    area += part[1];
  }
  return sum / area;
}

}  // namespace ck::poisson
