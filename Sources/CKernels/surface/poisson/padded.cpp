#include "surface/poisson/padded.h"

#include "surface/poisson/field.h"

namespace ck::poisson {

namespace {

bool touches_side(const Coordinates& brick, int side) {
  for (int c : brick) {
    if (c == 0 || kSide * (c + 1) >= side) return true;
  }
  return false;
}

/// Row by row: all nodes around the brick are in the cube.
void gather_inside(const BrickSet& bricks, size_t brick, const float* values, size_t stride,
                   Padded& padded) {
  for (int z = -1; z <= kSide; ++z) {
    for (int y = -1; y <= kSide; ++y) {
      float* row = &padded[padded_index(0, y + 1, z + 1)];
      const auto part = [&](int x) -> const float* {
        const int32_t other = bricks.neighbor(brick, x, y >> 3, z >> 3);
        return other < 0 ? nullptr : values + other * stride + local_index({0, y, z});
      };
      const float *before = part(-1), *own = part(0), *after = part(1);
      row[0] = before ? before[kSide - 1] : 0;
      for (int x = 0; x < kSide; ++x) row[x + 1] = own ? own[x] : 0;
      row[kSide + 1] = after ? after[0] : 0;
    }
  }
}

}  // namespace

void gather(const BrickSet& bricks, size_t brick, const float* values, size_t stride, int side,
            Beyond beyond, Padded& padded) {
  const Coordinates corner = bricks.coordinates(brick);
  if (!touches_side(corner, side)) return gather_inside(bricks, brick, values, stride, padded);
  for (int z = -1; z <= kSide; ++z) {
    for (int y = -1; y <= kSide; ++y) {
      for (int x = -1; x <= kSide; ++x) {
        Coordinates at{x, y, z};
        bool is_outside = false;
        for (size_t a = 0; a < 3; ++a) {
          const int node = kSide * corner[a] + at[a];
          if (node >= 0 && node <= side) continue;
          is_outside = true;
          at[a] = (node < 0 ? -node : 2 * side - node) - kSide * corner[a];
        }
        float& value = padded[padded_index(x + 1, y + 1, z + 1)] = 0;
        if (is_outside && beyond == Beyond::zero) continue;
        const auto [other, index] = resolve(bricks, brick, at);
        if (other >= 0) value = values[other * stride + index];
      }
    }
  }
}

}  // namespace ck::poisson
