#pragma once

#include "surface/poisson/octree.h"

namespace ck::poisson {

/// Weight of the samples' values relative to the gradients. Measured: F at 1 mm was 0.909, 0.911
/// and 0.912 for boot with 1, 2 and 4, and 0.842, 0.843, 0.844 and 0.844 for orbit with 1, 2, 4 and
/// 8 (on `c55c9be`), and a larger weight follows noise more closely.
constexpr float kScreening = 4;

/// Gauss–Seidel sweeps over the nodes of a level.
void relax(Level& level, int sweeps, const ck_control* control);

}  // namespace ck::poisson
