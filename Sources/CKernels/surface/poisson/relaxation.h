#pragma once

#include "surface/poisson/octree.h"

namespace ck::poisson {

/// Weight of the samples' values relative to the gradients. Chosen: F of boot at 1 mm is 0.909,
/// 0.911 and 0.912 with 1, 2 and 4, that of orbit 0.842, 0.843, 0.844 and 0.844 with 8, and a
/// larger weight follows noise more closely.
constexpr float kScreening = 4;

/// Gauss–Seidel sweeps over the nodes of a level.
void relax(Level& level, int sweeps, const ck_control* control);

}  // namespace ck::poisson
