#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "surface/points.h"

namespace {

/// Grid cell: level, x, y, z.
using Cell = std::array<int32_t, 4>;

/// The cell coordinate of a value, clamped to ±1e9.
int32_t coordinate(float value, double size) {
  const double limit = 1e9;
  return static_cast<int32_t>(std::min(limit, std::max(-limit, std::floor(value / size))));
}

std::vector<Cell> cells_of(const ck::StridedPoints& points, double size, const int8_t* levels) {
  std::vector<Cell> cells(points.count);
  for (size_t i = 0; i < points.count; ++i) {
    const int32_t level = levels ? levels[i] : 0;
    const double side = std::ldexp(size, level);
    const float* p = points[i];
    cells[i] = {level, coordinate(p[0], side), coordinate(p[1], side), coordinate(p[2], side)};
  }
  return cells;
}

/// The distinct cells in lexicographic order; `numbers` receives the cell index of each finite
/// point, −1 for others.
std::vector<Cell> number(const ck::StridedPoints& points, const std::vector<Cell>& cells,
                         int32_t* numbers, const ck_control* control) {
  std::vector<uint32_t> order;
  order.reserve(points.count);
  for (size_t i = 0; i < points.count; ++i) {
    numbers[i] = -1;
    if (points.is_finite(i)) order.push_back(static_cast<uint32_t>(i));
  }
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return cells[a] < cells[b]; });
  ck::step(control, 0.5);
  std::vector<Cell> distinct;
  for (uint32_t i : order) {
    if (distinct.empty() || distinct.back() != cells[i]) distinct.push_back(cells[i]);
    numbers[i] = static_cast<int32_t>(distinct.size()) - 1;
  }
  return distinct;
}

struct UnionFind {
  std::vector<int32_t> parent;

  explicit UnionFind(size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }

  int32_t root(int32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }

  /// The lower index becomes the root.
  void join(int32_t a, int32_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
};

/// Unites each cell with those of its 26 neighbors that come later in the order.
///
/// For each of the rows (dx, dy) a cursor follows the sorted cells, so that no search is needed.
std::vector<int32_t> join_cells(const std::vector<Cell>& cells, size_t* count,
                                const ck_control* control) {
  UnionFind sets(cells.size());
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
        sets.join(static_cast<int32_t>(i), static_cast<int32_t>(k));
      }
    }
  }
  std::vector<int32_t> component(cells.size());
  int32_t next = 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    const int32_t root = sets.root(static_cast<int32_t>(i));
    component[i] = root == static_cast<int32_t>(i) ? next++ : component[root];
  }
  *count = static_cast<size_t>(next);
  return component;
}

}  // namespace

ck_status ck_voxel_cells(const float* positions, size_t stride, size_t count, double cell_size,
                         const int8_t* levels, const ck_control* control, int32_t* cells,
                         size_t* cell_count, int32_t* components, size_t* component_count) {
  return ck::guarded([&] {
    ck::require(cells && cell_count && (positions || count == 0), "null pointer");
    ck::require(std::isfinite(cell_size) && cell_size > 0, "the cell size must be positive");
    ck::require(count < (size_t{1} << 31), "too many points");
    const ck::StridedPoints points{positions, stride, count};
    ck::step(control, 0);
    const auto distinct = number(points, cells_of(points, cell_size, levels), cells, control);
    *cell_count = distinct.size();
    if (!components) return;
    ck::require(component_count, "null pointer");
    const auto component = join_cells(distinct, component_count, control);
    for (size_t i = 0; i < count; ++i) components[i] = cells[i] < 0 ? -1 : component[cells[i]];
    ck::step(control, 1);
  });
}
