#pragma once

#include <array>

#include "surface/poisson/octree.h"

namespace ck::poisson {

/// Limit: the nodes of the level above among which a brick lies: five per axis, of which each
/// second node of the brick is one.
constexpr int kParents = kSide / 2 + 1;
using ParentValues = std::array<float, kParents * kParents * kParents>;

/// The values of these nodes; zero for those that are not stored. `stride` is the number of values
/// from one brick of the level above to the next.
ParentValues parent_values(const Level& above, const Level& level, size_t brick,
                           const float* values, size_t stride);

/// Interpolates the 512 values of a brick.
void prolong(const ParentValues& parents, float* values);

/// Adds the right-hand side of a level to that of the level above: a function of the level above is
/// a sum of functions of the level.
void restrict_rhs(const Level& level, Level& above, const ck_control* control);

}  // namespace ck::poisson
