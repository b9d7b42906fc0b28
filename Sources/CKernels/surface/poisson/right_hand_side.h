#pragma once

#include <vector>

#include "surface/poisson/octree.h"

namespace ck::poisson {

/// Sets the right-hand sides of all levels: the integrals of the gradients of the nodes' functions
/// with the field of the samples' normals.
void make_right_hand_sides(std::vector<Level>& levels, const Samples& samples,
                           const ck_control* control);

}  // namespace ck::poisson
