#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/poisson/octree.h"

namespace ck::poisson {

/// A leaf of the octree.
struct Leaf {
  /// Unique among all leaves; 0 if there is none.
  uint32_t id = 0;
  /// At its center, less that of the surface; not zero.
  float value = 0;
  /// Of its center, in the unit cube.
  std::array<double, 3> center{};
};

/// The values at the centers of the cells of all levels, and which cells are leaves.
class Leaves {
 public:
  /// `surface` is the value on the surface.
  Leaves(const std::vector<Level>& levels, double surface, const ck_control* control);

  /// Whether a cell has children.
  bool is_refined(size_t level, size_t brick, size_t cell) const {
    return refined_[level][brick][cell];
  }
  float value(size_t level, size_t brick, size_t cell) const {
    return values_[level][brick * kBrick + cell];
  }
  Leaf leaf(size_t level, size_t brick, size_t cell) const;
  /// The leaf in which a cell of a level lies that does not exist; its id is 0 outside the cube.
  Leaf leaf_around(size_t level, Coordinates cell) const;

 private:
  void find_values(size_t level, size_t brick, float surface);
  void mark_parents(size_t level, size_t brick);

  const std::vector<Level>& levels_;
  /// The id of each level's first cell.
  std::vector<uint32_t> first_ids_;
  std::vector<std::vector<float>> values_;
  std::vector<std::vector<Mask>> refined_;
};

}  // namespace ck::poisson
