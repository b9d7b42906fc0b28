#pragma once

#include <vector>

#include "surface/poisson/octree.h"

namespace ck::poisson {

/// Determines the values of all levels: those of the function whose gradient is closest to the
/// field of the samples' normals, and that is closest to zero at the samples (Kazhdan and Hoppe
/// 2013, equation 3, with trilinear functions).
///
/// Cascadic multigrid: levels are solved from coarse to fine, each from the values of the one
/// above, which also hold around its nodes.
/// Levels of `base`, whose values are known, are not solved again.
void solve(std::vector<Level>& levels, const Samples& samples, const std::vector<Level>& base,
           const ck_control* control);

/// The mean of the function at the samples, weighted by their areas.
double mean_value(const std::vector<Level>& levels, const Samples& samples,
                  const ck_control* control);

}  // namespace ck::poisson
