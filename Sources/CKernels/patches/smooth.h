#pragma once

#include "patches/grid.h"

namespace ck::patches {

/// Smooths patches where texture is too weak to determine their depth: the maximum a posteriori
/// estimate under a prior of smooth surfaces. The texture is weighted against the prior by its
/// Fisher information, so that richly textured patches stay unchanged.
///
/// Edge-avoiding à-trous filtering (Dammertz et al., HPG 2010) of planes instead of values.
void smooth(Grid& grid, const Comparison& comparison);

}  // namespace ck::patches
