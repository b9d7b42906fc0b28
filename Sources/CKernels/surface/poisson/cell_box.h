#pragma once

#include <algorithm>

#include "surface/poisson/bricks.h"

namespace ck::poisson {

/// The cells of a level from `low` to before `high`, per axis, and the nodes at their lowest
/// corners. Nodes at the far sides of the cube belong to the last cells.
struct CellBox {
  int depth = 0;
  Coordinates low{0, 0, 0}, high{1, 1, 1};

  /// Whether it has a node of some level.
  bool has_node(const Coordinates& node, int level) const {
    for (size_t a = 0; a < 3; ++a) {
      const int cell = cell_at(node[a], level);
      if (cell < low[a] || cell >= high[a]) return false;
    }
    return true;
  }

  /// Whether it has a node of a brick of some level, or one that is at most `reach` nodes away.
  bool touches(const Coordinates& brick, int level, int reach = 0) const {
    for (size_t a = 0; a < 3; ++a) {
      const int first = kSide * brick[a] - reach, last = first + kSide - 1 + 2 * reach;
      if (cell_at(last, level) < low[a] || cell_at(std::max(first, 0), level) >= high[a]) {
        return false;
      }
    }
    return true;
  }

 private:
  int cell_at(int node, int level) const {
    const int cell = level >= depth ? node >> (level - depth) : node << (depth - level);
    return std::min(cell, (1 << depth) - 1);
  }
};

}  // namespace ck::poisson
