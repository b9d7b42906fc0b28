#include "surface/poisson/leaves.h"

#include <limits>
#include <new>

#include "surface/poisson/field.h"

namespace ck::poisson {

Leaves::Leaves(const std::vector<Level>& levels, double surface, const ck_control* control)
    : levels_(levels) {
  uint64_t first = 1;
  for (const Level& level : levels) {
    const size_t count = level.bricks.count();
    first_ids_.push_back(static_cast<uint32_t>(first));
    first += count * kBrick;
    if (first > std::numeric_limits<uint32_t>::max()) throw std::bad_alloc();
    values_.emplace_back(count * kBrick);
    refined_.emplace_back(count);
  }
  for (size_t l = 0; l < levels.size(); ++l) {
    parallel_for(control, levels[l].bricks.count(),
                 [&](size_t b) { find_values(l, b, static_cast<float>(surface)); });
  }
  for (size_t l = 1; l < levels.size(); ++l) {
    // Bricks with the same parent have different colors.
    for_colors(levels[l].bricks, 2, control, [&](size_t b) { mark_parents(l, b); });
  }
}

void Leaves::find_values(size_t l, size_t b, float surface) {
  const Level& level = levels_[l];
  for (int i = 0; i < kBrick; ++i) {
    if (!level.cells[b][i]) continue;
    float sum = 0;
    for (int k = 0; k < 8; ++k) {
      const auto [other, index] = resolve(level.bricks, b, corner(local_coordinates(i), k));
      sum += level.values[other * size_t{kBrick} + index];
    }
    const float value = sum / 8 - surface;
    // At zero, vertices of several edges would coincide.
    values_[l][b * kBrick + i] = value == 0 ? std::numeric_limits<float>::min() : value;
  }
}

void Leaves::mark_parents(size_t l, size_t b) {
  const Level& level = levels_[l];
  const int32_t parent = level.parents[b];
  if (parent < 0) return;
  const Coordinates c = level.bricks.coordinates(b);
  for (int i = 0; i < kBrick; ++i) {
    if (!level.cells[b][i]) continue;
    Coordinates at = local_coordinates(i);
    for (size_t a = 0; a < 3; ++a) at[a] = (kSide * c[a] + at[a]) >> 1;
    refined_[l - 1][parent][local_index(at)] = true;
  }
}

Leaf Leaves::leaf(size_t l, size_t brick, size_t cell) const {
  Leaf leaf;
  leaf.id = first_ids_[l] + static_cast<uint32_t>(brick * kBrick + cell);
  leaf.value = value(l, brick, cell);
  const Coordinates corner = levels_[l].bricks.coordinates(brick);
  const Coordinates at = local_coordinates(static_cast<int>(cell));
  for (size_t a = 0; a < 3; ++a) {
    leaf.center[a] = (kSide * corner[a] + at[a] + 0.5) / levels_[l].side();
  }
  return leaf;
}

Leaf Leaves::leaf_around(size_t l, Coordinates cell) const {
  for (int c : cell) {
    if (c < 0 || c >= levels_[l].side()) return Leaf();
  }
  while (l-- > 0) {
    for (int& c : cell) c >>= 1;
    const int32_t b = levels_[l].bricks.find({cell[0] / kSide, cell[1] / kSide, cell[2] / kSide});
    if (b >= 0 && levels_[l].cells[b][local_index(cell)]) return leaf(l, b, local_index(cell));
  }
  return Leaf();
}

}  // namespace ck::poisson
