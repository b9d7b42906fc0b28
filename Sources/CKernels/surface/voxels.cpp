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

std::vector<Cell> cells_of(const ck::Strided<float>& points, double size, const int8_t* levels,
                           const ck_control* control) {
  std::vector<Cell> cells(points.count);
  ck::parallel_for_blocks(control, points.count, kBlock, [&](size_t i) {
    const int32_t level = levels ? levels[i] : 0;
    const double side = std::ldexp(size, level);
    const float* p = points[i];
    cells[i] = {level, coordinate(p[0], side), coordinate(p[1], side), coordinate(p[2], side)};
  });
  return cells;
}

/// The bits of a key for each number of a cell; keys are in the lexicographic order of the cells.
struct KeyLayout {
  Cell low;
  std::array<int, 4> bits = {0, 0, 0, 0};

  /// The least number of bits for the cells of the finite points.
  KeyLayout(const ck::Strided<float>& points, const std::vector<Cell>& cells,
            const ck_control* control) {
    const size_t blocks = (cells.size() + kBlock - 1) / kBlock;
    std::vector<Cell> lows(blocks + 1, full(INT32_MAX)), highs(blocks + 1, full(INT32_MIN));
    ck::parallel_for(control, blocks, [&](size_t block) {
      for (size_t i = block * kBlock; i < std::min(cells.size(), (block + 1) * kBlock); ++i) {
        if (points.is_finite(i)) widen(cells[i], lows[block], highs[block]);
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

/// The distinct cells in lexicographic order; `numbers` receives the cell index of each finite
/// point, −1 for others.
template <typename Key>
std::vector<Cell> number(const ck::Strided<float>& points, std::vector<Cell> cells,
                         const KeyLayout& layout, int32_t* numbers, const ck_control* control) {
  std::vector<KeyedPoint<Key>> order;
  order.reserve(points.count);
  for (size_t i = 0; i < points.count; ++i) {
    numbers[i] = -1;
    if (points.is_finite(i)) {
      order.push_back({layout.pack<Key>(cells[i]), static_cast<uint32_t>(i)});
    }
  }
  cells = {};
  ck::parallel_sort(
      order, [](const auto& a, const auto& b) { return a.key < b.key; }, control);
  ck::step(control, 0.5);
  const auto is_first = [&](size_t k) { return k == 0 || order[k].key != order[k - 1].key; };
  const auto end = [&](size_t block) { return std::min(order.size(), (block + 1) * kBlock); };
  // The number of cells before each block of the order.
  std::vector<size_t> starts((order.size() + kBlock - 1) / kBlock + 1, 0);
  const ck_control quiet{nullptr, nullptr, ck::thread_count(control)};
  ck::parallel_for(&quiet, starts.size() - 1, [&](size_t block) {
    for (size_t k = block * kBlock; k < end(block); ++k) starts[block + 1] += is_first(k);
  });
  for (size_t block = 1; block < starts.size(); ++block) starts[block] += starts[block - 1];
  std::vector<Cell> distinct(starts.back());
  ck::parallel_for(&quiet, starts.size() - 1, [&](size_t block) {
    size_t next = starts[block];
    for (size_t k = block * kBlock; k < end(block); ++k) {
      if (is_first(k)) distinct[next++] = layout.unpack(order[k].key);
      numbers[order[k].index] = static_cast<int32_t>(next) - 1;
    }
  });
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
                         int32_t* components, size_t* component_count) {
  return ck::guarded([&] {
    const ck::Strided<float> points(positions);
    const size_t count = points.count;
    ck::require(cells && cell_count && (positions.data || count == 0), "null pointer");
    ck::require(std::isfinite(cell_size) && cell_size > 0, "the cell size must be positive");
    ck::require(count < (size_t{1} << 31), "too many points");
    ck::step(control, 0);
    const ck_control quiet{nullptr, nullptr, ck::thread_count(control)};
    std::vector<Cell> all = cells_of(points, cell_size, levels, &quiet);
    const KeyLayout layout(points, all, &quiet);
    const auto distinct =
        layout.size() <= 64
            ? number<uint64_t>(points, std::move(all), layout, cells, control)
            : number<unsigned __int128>(points, std::move(all), layout, cells, control);
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
