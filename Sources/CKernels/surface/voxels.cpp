#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ck_surface.h"
#include "core/disjoint_sets.h"
#include "core/guard.h"
#include "core/parallel_sort.h"
#include "core/span.h"

namespace {

/// Number of points that a thread works on at a time. Chosen: less than a millisecond.
constexpr size_t kBlock = 1 << 14;

/// Grid cell: level, x, y, z.
using Cell = std::array<int32_t, 4>;

/// Largest magnitude of a cell coordinate. Limit: neighbors must be within 32 bits.
constexpr double kMaximumCoordinate = 1e9;

/// The cell coordinate of a value, clamped.
int32_t coordinate(float value, double size) {
  return static_cast<int32_t>(
      std::min(kMaximumCoordinate, std::max(-kMaximumCoordinate, std::floor(value / size))));
}

/// The cells of points.
struct Grid {
  const ck::Strided<float>& points;
  double size;
  const int8_t* levels;

  Cell cell(size_t i) const {
    const int32_t level = levels ? levels[i] : 0;
    const double side = std::ldexp(size, level);
    const float* p = points[i];
    return {level, coordinate(p[0], side), coordinate(p[1], side), coordinate(p[2], side)};
  }
};

/// The bits of a key for each number of a cell; keys are in the lexicographic order of the cells.
struct KeyLayout {
  Cell low;
  std::array<int, 4> bits = {0, 0, 0, 0};

  /// The least number of bits for the cells of the finite points.
  KeyLayout(const Grid& grid, const ck_control* control) {
    const size_t count = grid.points.count, blocks = (count + kBlock - 1) / kBlock;
    std::vector<Cell> lows(blocks + 1, full(INT32_MAX)), highs(blocks + 1, full(INT32_MIN));
    ck::parallel_for(control, blocks, [&](size_t block) {
      for (size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
        if (grid.points.is_finite(i)) widen(grid.cell(i), lows[block], highs[block]);
      }
    });
    low = lows[blocks];
    Cell high = highs[blocks];
    for (size_t block = 0; block < blocks; ++block) {
      for (size_t a = 0; a < 4; ++a) {
        low[a] = std::min(low[a], lows[block][a]);
        high[a] = std::max(high[a], highs[block][a]);
      }
    }
    for (size_t a = 0; a < 4; ++a) {
      while (int64_t{1} << bits[a] <= int64_t{high[a]} - low[a]) ++bits[a];
    }
  }

  int size() const { return bits[0] + bits[1] + bits[2] + bits[3]; }

  template <typename Key>
  Key pack(const Cell& cell) const {
    Key key = 0;
    for (size_t a = 0; a < 4; ++a) key = key << bits[a] | Key(int64_t{cell[a]} - low[a]);
    return key;
  }

  template <typename Key>
  Cell unpack(Key key) const {
    Cell cell;
    for (size_t a = 4; a-- > 0;) {
      cell[a] = int32_t(int64_t(key & ((Key(1) << bits[a]) - 1)) + low[a]);
      key >>= bits[a];
    }
    return cell;
  }

 private:
  static Cell full(int32_t value) { return {value, value, value, value}; }

  static void widen(const Cell& cell, Cell& low, Cell& high) {
    for (size_t a = 0; a < 4; ++a) {
      low[a] = std::min(low[a], cell[a]);
      high[a] = std::max(high[a], cell[a]);
    }
  }
};

/// A point with the key of its cell.
template <typename Key>
struct KeyedPoint {
  Key key;
  uint32_t index;
};

/// The finite points with the keys of their cells, in the order of the input.
template <typename Key>
ck::Uninitialized<KeyedPoint<Key>> keyed_points(const Grid& grid, const KeyLayout& layout,
                                                const ck_control* control) {
  const size_t count = grid.points.count, blocks = (count + kBlock - 1) / kBlock;
  const auto end = [&](size_t block) { return std::min(count, (block + 1) * kBlock); };
  // The number of finite points before each block.
  std::vector<size_t> starts(blocks + 1, 0);
  ck::parallel_for(control, blocks, [&](size_t block) {
    for (size_t i = block * kBlock; i < end(block); ++i) {
      starts[block + 1] += grid.points.is_finite(i);
    }
  });
  for (size_t block = 0; block < blocks; ++block) starts[block + 1] += starts[block];
  ck::Uninitialized<KeyedPoint<Key>> found(starts.back());
  ck::parallel_for(control, blocks, [&](size_t block) {
    size_t next = starts[block];
    for (size_t i = block * kBlock; i < end(block); ++i) {
      if (!grid.points.is_finite(i)) continue;
      found[next++] = {layout.pack<Key>(grid.cell(i)), static_cast<uint32_t>(i)};
    }
  });
  return found;
}

/// The distinct cells in lexicographic order; `numbers` receives the cell index of each finite
/// point, −1 for others. `members` and `starts`, if given, receive the points of each cell.
template <typename Key>
std::vector<Cell> number(const Grid& grid, const KeyLayout& layout, int32_t* numbers,
                         int32_t* members, int32_t* starts_of_cells, const ck_control* control) {
  const ck_control quiet{nullptr, nullptr, ck::thread_count(control)};
  auto order = keyed_points<Key>(grid, layout, &quiet);
  std::fill(numbers, numbers + grid.points.count, -1);
  ck::parallel_sort(
      order,
      [](const auto& a, const auto& b) {
        return a.key != b.key ? a.key < b.key : a.index < b.index;
      },
      control);
  ck::step(control, 0.5);
  const auto is_first = [&](size_t k) { return k == 0 || order[k].key != order[k - 1].key; };
  const auto end = [&](size_t block) { return std::min(order.size(), (block + 1) * kBlock); };
  // The number of cells before each block of the order.
  std::vector<size_t> starts((order.size() + kBlock - 1) / kBlock + 1, 0);
  ck::parallel_for(&quiet, starts.size() - 1, [&](size_t block) {
    for (size_t k = block * kBlock; k < end(block); ++k) starts[block + 1] += is_first(k);
  });
  for (size_t block = 1; block < starts.size(); ++block) starts[block] += starts[block - 1];
  std::vector<Cell> distinct(starts.back());
  ck::parallel_for(&quiet, starts.size() - 1, [&](size_t block) {
    size_t next = starts[block];
    for (size_t k = block * kBlock; k < end(block); ++k) {
      if (is_first(k)) {
        if (members) starts_of_cells[next] = static_cast<int32_t>(k);
        distinct[next++] = layout.unpack(order[k].key);
      }
      numbers[order[k].index] = static_cast<int32_t>(next) - 1;
      if (members) members[k] = static_cast<int32_t>(order[k].index);
    }
  });
  if (members) starts_of_cells[distinct.size()] = static_cast<int32_t>(order.size());
  return distinct;
}

/// Unites each cell with those of its 26 neighbors that come later in the order.
///
/// For each of the rows (dx, dy) a cursor follows the sorted cells, so that no search is needed.
std::vector<int32_t> join_cells(const std::vector<Cell>& cells, size_t* count,
                                const ck_control* control) {
  ck::DisjointSets sets(cells.size());
  const int rows[5][2] = {{0, 0}, {0, 1}, {1, -1}, {1, 0}, {1, 1}};
  for (const auto& row : rows) {
    ck::step(control, 0.5);
    size_t cursor = 0;
    for (size_t i = 0; i < cells.size(); ++i) {
      const Cell& c = cells[i];
      const Cell first = {c[0], c[1] + row[0], c[2] + row[1], c[3] - 1};
      while (cursor < cells.size() && cells[cursor] < first) ++cursor;
      for (size_t k = cursor; k < cells.size(); ++k) {
        const Cell& d = cells[k];
        if (d[0] != first[0] || d[1] != first[1] || d[2] != first[2] || d[3] > c[3] + 1) break;
        sets.join(static_cast<uint32_t>(i), static_cast<uint32_t>(k));
      }
    }
  }
  std::vector<int32_t> component(cells.size());
  int32_t next = 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    const uint32_t root = sets.root(static_cast<uint32_t>(i));
    component[i] = root == i ? next++ : component[root];
  }
  *count = static_cast<size_t>(next);
  return component;
}

}  // namespace

ck_status ck_voxel_cells(ck_span positions, double cell_size, const int8_t* levels,
                         const ck_control* control, int32_t* cells, size_t* cell_count,
                         int32_t* members, int32_t* starts, bool finds_members, int32_t* components,
                         size_t* component_count) {
  return ck::guarded([&] {
    const ck::Strided<float> points(positions);
    const size_t count = points.count;
    ck::require(cells && cell_count && (positions.data || count == 0), "null pointer");
    ck::require(!finds_members || (members && starts), "null pointer");
    if (!finds_members) members = nullptr;
    ck::require(std::isfinite(cell_size) && cell_size > 0, "the cell size must be positive");
    ck::require(count < (size_t{1} << 31), "too many points");
    ck::step(control, 0);
    const ck_control quiet{nullptr, nullptr, ck::thread_count(control)};
    const Grid grid{points, cell_size, levels};
    const KeyLayout layout(grid, &quiet);
    const auto distinct =
        layout.size() <= 64
            ? number<uint64_t>(grid, layout, cells, members, starts, control)
            : number<unsigned __int128>(grid, layout, cells, members, starts, control);
    *cell_count = distinct.size();
    if (!components) return;
    ck::require(component_count, "null pointer");
    const auto component = join_cells(distinct, component_count, control);
    ck::parallel_for_blocks(&quiet, count, kBlock, [&](size_t i) {
      components[i] = cells[i] < 0 ? -1 : component[size_t(cells[i])];
    });
    ck::step(control, 1);
  });
}
