#pragma once

#include <array>

#include "surface/poisson/bricks.h"

namespace ck::poisson {

/// The values at a brick's nodes and at those around it, which start at −1.
using Padded = std::array<float, kPadded * kPadded * kPadded>;

/// What lies beyond the sides of the cube.
enum class Beyond {
  /// The values are mirrored: the natural boundary condition.
  mirrored,
  zero
};

/// The values around a brick of a level with `side` cells per axis; `stride` is the number of
/// values from one brick to the next. Nodes that are not stored are zero.
void gather(const BrickSet& bricks, size_t brick, const float* values, size_t stride, int side,
            Beyond beyond, Padded& padded);

/// Calls `body(index, x, y, z)` for the nodes of a brick in the order in which they are stored.
template <typename Body>
void for_nodes(Body&& body) {
  for (int z = 0, i = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x, ++i) body(i, x, y, z);
    }
  }
}

}  // namespace ck::poisson
