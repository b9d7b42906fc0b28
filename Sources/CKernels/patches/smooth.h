#pragma once

#include "patches/grid.h"

namespace ck::patches {

/// Smooths patches where texture is too weak to tell where they lie: the estimate of largest
/// posterior probability under a prior of smooth surface. What texture says counts against the
/// prior by its information, so that patches on rich texture stay as they are.
///
/// Edge-avoiding à-trous averages (Dammertz et al., HPG 2010) of planes instead of values.
void smooth(Grid& grid, const Comparison& comparison);

}  // namespace ck::patches
