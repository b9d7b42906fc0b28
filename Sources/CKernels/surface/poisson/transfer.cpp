#include "surface/poisson/transfer.h"

#include "surface/poisson/field.h"
#include "surface/poisson/padded.h"

namespace ck::poisson {

namespace {

/// The parent `k` of eight of a node of a brick: a node that the parents share is each of them.
size_t parent_index(int x, int y, int z, int k) {
  const int px = (x + (k & 1)) >> 1, py = (y + (k >> 1 & 1)) >> 1, pz = (z + (k >> 2)) >> 1;
  return static_cast<size_t>((pz * kParents + py) * kParents + px);
}

/// Calls `body(i, brick, index)` for the stored nodes of the level above, with their number among
/// those around a brick.
template <typename Body>
void for_parents(const Level& above, const Level& level, size_t brick, Body&& body) {
  const int32_t parent = level.parents[brick];
  if (parent < 0) return;
  const Coordinates c = level.bricks.coordinates(brick);
  Coordinates start;
  for (size_t a = 0; a < 3; ++a) start[a] = (c[a] & 1) * (kSide / 2);
  for (int z = 0, i = 0; z < kParents; ++z) {
    for (int y = 0; y < kParents; ++y) {
      for (int x = 0; x < kParents; ++x, ++i) {
        const auto [other, index] =
            resolve(above.bricks, parent, {start[0] + x, start[1] + y, start[2] + z});
        if (other >= 0) body(i, static_cast<size_t>(other), index);
      }
    }
  }
}

}  // namespace

ParentValues parent_values(const Level& above, const Level& level, size_t brick,
                           const float* values, size_t stride) {
  ParentValues found{};
  for_parents(above, level, brick, [&](int i, size_t other, size_t index) {
    found[i] = values[other * stride + index];
  });
  return found;
}

void prolong(const ParentValues& parents, float* values) {
  for_nodes([&](int i, int x, int y, int z) {
    float sum = 0;
    for (int k = 0; k < 8; ++k) sum += parents[parent_index(x, y, z, k)];
    values[i] = sum / 8;
  });
}

void restrict_rhs(const Level& level, Level& above, const ck_control* control) {
  // Two bricks that are four apart have no parent in common.
  for_colors(level.bricks, 4, control, [&](size_t b) {
    ParentValues sums{};
    const float* rhs = level.rhs.data() + b * kBrick;
    for_nodes([&](int i, int x, int y, int z) {
      if (rhs[i] == 0) return;
      for (int k = 0; k < 8; ++k) sums[parent_index(x, y, z, k)] += rhs[i] / 8;
    });
    for_parents(above, level, b, [&](int i, size_t other, size_t index) {
      above.rhs[other * kBrick + index] += sums[i];
    });
  });
}

}  // namespace ck::poisson
