#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/poisson/cell_box.h"
#include "surface/poisson/octree.h"

namespace ck::poisson {

struct Contour {
  /// In the unit cube.
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// The surface on which the function has a value, without cracks; open where it leaves the cube.
///
/// Marching cubes on the dual grid of the octree (Schaefer and Warren, "Dual marching cubes: primal
/// contouring of dual grids", Pacific Graphics 2004): the corners of its cells are the centers of
/// the leaves around a node, which may coincide. Triangles are counter-clockwise seen from where
/// the function is larger.
///
/// Only the part around the nodes in `box`; contours of boxes that adjoin fit together.
Contour contour(const std::vector<Level>& levels, double value, const CellBox& box,
                const ck_control* control);

}  // namespace ck::poisson
