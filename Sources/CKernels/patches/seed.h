#pragma once

#include "patches/grid.h"

namespace ck::patches {

/// Lays the planes of the seeds' Delaunay triangles over the grid.
///
/// `scale` takes the reference's pixels to the grid's. Pixels outside all triangles stay empty.
void seed(Grid& grid, const Comparison& comparison, const ck_patch_seed* seeds, size_t count,
          double scale);

}  // namespace ck::patches
