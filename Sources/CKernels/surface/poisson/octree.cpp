#include "surface/poisson/octree.h"

#include <algorithm>
#include <cstddef>

#include "surface/poisson/field.h"

namespace ck::poisson {

namespace {

/// The cells that exist around a sample, as a range per axis: all children of some parents.
///
/// At the finest level, these are the two parents per axis that are nearest to the sample's cell.
/// Coarser levels reach one or two parents farther: where there are no samples, triangles grow with
/// the distance from them, not at once.
class Neighborhood {
 public:
  explicit Neighborhood(int levels_below) : reach_(std::min(levels_below, kMaximumReach)) {}

  int count() const { return reach_ == 0 ? 4 : 4 * reach_ + 2; }
  Coordinates first(const Coordinates& cell) const {
    Coordinates first;
    for (size_t a = 0; a < 3; ++a) {
      first[a] = reach_ == 0 ? (cell[a] - 1) & ~1 : 2 * ((cell[a] >> 1) - reach_);
    }
    return first;
  }

 private:
  /// Measured: without the reach of coarser levels, the guessed back of dtu_scan24 has spikes where
  /// fine triangles meet coarse ones (docs/experiments/2026-11-surface.md, "Poisson surface").
  static constexpr int kMaximumReach = 2;

  /// Number of parents on each side of a cell's parent.
  int reach_;
};

/// The bricks that hold the cells, their nodes, and the nodes around these.
BrickSet make_bricks(const Level& level, const Samples& samples, const Neighborhood& around,
                     const ck_control* control) {
  if (level.depth <= kFullDepth) {
    BrickCodes codes;
    codes.add({0, 0, 0}, 0, level.side(), level.side());
    return BrickSet(codes.take(), control);
  }
  const auto codes = samples.map_blocks(control, [&](size_t first, size_t last) {
    BrickCodes part;
    samples.for_cells(first, last, level.depth, level.least_depth(), [&](const Coordinates& cell) {
      part.add(around.first(cell), 1, around.count() + 1, level.side());
    });
    return part.take();
  });
  return BrickSet(merged(codes), control);
}

void mark_all_cells(Level& level) {
  for (size_t b = 0; b < level.bricks.count(); ++b) {
    const Coordinates corner = level.bricks.coordinates(b);
    for (int i = 0; i < kBrick; ++i) {
      const Coordinates at = local_coordinates(i);
      bool exists = true;
      for (size_t a = 0; a < 3; ++a) exists = exists && kSide * corner[a] + at[a] < level.side();
      level.cells[b][i] = exists;
    }
  }
}

/// Marks the cells around those that have samples.
void mark_sampled_cells(Level& level, const Samples& samples, const Neighborhood& around,
                        const ck_control* control) {
  const int count = around.count();
  for_colors(level.bricks, 3, control, [&](size_t b) {
    const auto [first, last] = samples.range(level.bricks.code(b), level.depth);
    const Coordinates corner = level.bricks.coordinates(b);
    Coordinates before{-kSide, -kSide, -kSide};
    const auto mark = [&](const Coordinates& c) {
      const Coordinates low = around.first(c);
      // Siblings, which follow each other, may have the same neighborhood.
      if (low == before) return;
      before = low;
      for (int i = 0; i < count * count * count; ++i) {
        const int offsets[3] = {i % count, i / count % count, i / (count * count)};
        Coordinates at;
        bool exists = true;
        for (size_t a = 0; a < 3; ++a) {
          const int cell = low[a] + offsets[a];
          exists = exists && cell >= 0 && cell < level.side();
          at[a] = cell - kSide * corner[a];
        }
        if (!exists) continue;
        const auto [other, index] = resolve(level.bricks, b, at);
        level.cells[other][index] = true;
      }
    };
    samples.for_cells(first, last, level.depth, level.least_depth(), mark);
  });
}

/// Adds the bricks of a base that are among those of a level or next to them, in whatever box that
/// these fill.
void add_bricks(const BrickSet& base, BrickSet& bricks, const ck_control* control) {
  if (bricks.count() == 0) return;
  Coordinates low = bricks.coordinates(0), high = low;
  std::vector<uint64_t> codes;
  for (size_t b = 0; b < bricks.count(); ++b) {
    const Coordinates c = bricks.coordinates(b);
    for (size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], c[a] - 1);
      high[a] = std::max(high[a], c[a] + 1);
    }
    codes.push_back(bricks.code(b));
  }
  for (size_t b = 0; b < base.count(); ++b) {
    const Coordinates c = base.coordinates(b);
    bool is_near = true;
    for (size_t a = 0; a < 3; ++a) is_near = is_near && low[a] <= c[a] && c[a] <= high[a];
    if (is_near) codes.push_back(base.code(b));
  }
  bricks = BrickSet(std::move(codes), control);
}

void add_cells(const Level& base, Level& level, const ck_control* control) {
  parallel_for(control, level.bricks.count(), [&](size_t b) {
    const int32_t other = base.bricks.find(level.bricks.coordinates(b));
    if (other >= 0) level.cells[b] |= base.cells[other];
  });
  drop_incomplete_cells(level, control);
}

/// Marks the corners of the cells.
void mark_nodes(Level& level, const ck_control* control) {
  parallel_for(control, level.bricks.count(), [&](size_t b) {
    for (int i = 0; i < kBrick; ++i) {
      const Coordinates node = local_coordinates(i);
      const Coordinates low{node[0] - 1, node[1] - 1, node[2] - 1};
      for (int k = 0; k < 8 && !level.nodes[b][i]; ++k) {
        level.nodes[b][i] = level.has_cell(b, corner(low, k));
      }
    }
  });
}

/// Averages the samples of each cell, whatever their depth.
std::vector<CellSample> average_samples(const Level& level, size_t b, const Samples& samples) {
  std::vector<CellSample> averages;
  const auto [first, last] = samples.range(level.bricks.code(b), level.depth);
  const double side = level.side();
  for (size_t i = first, end; i < last; i = end) {
    const uint64_t code = level.cell_code(samples.samples[i]);
    const Coordinates c = from_morton(code);
    double area = 0;
    std::array<double, 3> sum{};
    for (end = i; end < last && level.cell_code(samples.samples[end]) == code; ++end) {
      const Sample& s = samples.samples[end];
      area += s.area;
      for (size_t a = 0; a < 3; ++a) sum[a] += s.area * (s.position[a] * side - c[a]);
    }
    const size_t index = local_index(c);
    if (!level.cells[b][index]) continue;
    CellSample average{static_cast<uint16_t>(index), static_cast<float>(area * side * side), {}};
    for (size_t a = 0; a < 3; ++a) average.position[a] = static_cast<float>(sum[a] / area);
    averages.push_back(average);
  }
  return averages;
}

void gather_samples(Level& level, const Samples& samples, const ck_control* control) {
  std::vector<std::vector<CellSample>> parts(level.bricks.count());
  parallel_for(control, parts.size(),
               [&](size_t b) { parts[b] = average_samples(level, b, samples); });
  level.offsets.assign(1, 0);
  for (const std::vector<CellSample>& part : parts) {
    level.offsets.push_back(level.offsets.back() + static_cast<uint32_t>(part.size()));
  }
  level.samples.resize(level.offsets.back());
  parallel_for(control, parts.size(), [&](size_t b) {
    std::copy(parts[b].begin(), parts[b].end(),
              level.samples.begin() + std::ptrdiff_t(level.offsets[b]));
  });
}

}  // namespace

bool Level::has_cell(size_t brick, const Coordinates& at) const {
  const auto [other, index] = resolve(bricks, brick, at);
  return other >= 0 && cells[other][index];
}

void find_parents(Level& level, const Level& above, const ck_control* control) {
  // Bricks that a thread works on at a time. Chosen: each takes much less than a microsecond.
  constexpr size_t kBlock = 1024;
  level.parents.resize(level.bricks.count());
  parallel_for_blocks(control, level.bricks.count(), kBlock, [&](size_t b) {
    const Coordinates c = level.bricks.coordinates(b);
    level.parents[b] = above.bricks.find({c[0] >> 1, c[1] >> 1, c[2] >> 1});
  });
}

void drop_incomplete_cells(Level& level, const ck_control* control) {
  parallel_for(control, level.bricks.count(), [&](size_t b) {
    for (int i = 0; i < kBrick; ++i) {
      for (int k = 0; k < 8 && level.cells[b][i]; ++k) {
        level.cells[b][i] = resolve(level.bricks, b, corner(local_coordinates(i), k)).first >= 0;
      }
    }
  });
}

std::vector<Level> make_levels(const Samples& samples, int& depth, size_t maximum_bytes,
                               const std::vector<Level>& base, const ck_control* control) {
  std::vector<Level> levels;
  size_t all_bricks = 0;
  for (int d = kFirstDepth; d <= std::max(depth, kFirstDepth); ++d) {
    const ProgressPart part(control, static_cast<double>(d - kFirstDepth) / (depth + 1),
                            static_cast<double>(d + 1 - kFirstDepth) / (depth + 1));
    Level level;
    level.depth = d;
    const Neighborhood around(depth - d);
    level.bricks = make_bricks(level, samples, around, part.control());
    const Level* other = levels.size() < base.size() ? &base[levels.size()] : nullptr;
    if (other) add_bricks(other->bricks, level.bricks, part.control());
    const size_t count = level.bricks.count();
    if (count == 0) break;
    all_bricks += count;
    if (d > kFullDepth && all_bricks > maximum_bytes / kBytesPerBrick) {
      depth = d - 1;
      break;
    }
    level.cells.resize(count);
    level.nodes.resize(count);
    d <= kFullDepth ? mark_all_cells(level)
                    : mark_sampled_cells(level, samples, around, part.control());
    if (other) add_cells(*other, level, part.control());
    mark_nodes(level, part.control());
    gather_samples(level, samples, part.control());
    if (!levels.empty()) find_parents(level, levels.back(), part.control());
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace ck::poisson
