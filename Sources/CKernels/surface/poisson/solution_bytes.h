#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/poisson/solution.h"

namespace ck::poisson {

/// Serializes the bricks that the surface around the nodes of a box depends on, without what only
/// the solver needs.
std::vector<uint8_t> encoded(const Solution& solution, const CellBox& box);

/// These bricks of a box, of a serialized solution. Throws `std::invalid_argument` if the
/// bytes are malformed.
Solution decoded(const uint8_t* bytes, size_t count, const CellBox& box, const ck_control* control);

}  // namespace ck::poisson
