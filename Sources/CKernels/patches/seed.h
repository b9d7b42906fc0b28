#pragma once

#include "patches/grid.h"

namespace ck::patches {

/// Initializes the grid with the planes of the seeds' Delaunay triangles.
///
/// `scale` maps pixels of the reference to those of the grid. Pixels outside all triangles stay
/// empty.
void seed(Grid& grid, const Comparison& comparison, const ck_patch_seed* seeds, size_t count,
          double scale);

}  // namespace ck::patches
