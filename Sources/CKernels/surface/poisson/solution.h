#pragma once

#include <cstddef>
#include <vector>

#include "surface/poisson/cell_box.h"
#include "surface/poisson/octree.h"

namespace ck::poisson {

/// A solved function; the reconstructed surface is where it has a value.
struct Solution {
  Cube cube;
  std::vector<Level> levels;
  double value = 0;

  int depth() const { return levels.empty() ? 0 : levels.back().depth; }
};

/// The function of samples to `depth` at most, less if `maximum_bytes` do not suffice.
Solution solution(Samples samples, int depth, size_t maximum_bytes, const ck_control* control);

/// A part of the function of a scene: the levels of `base` around the samples, and those below,
/// which are solved for the samples. `samples` have the cube of the base.
///
/// Parts differ near their borders, where samples are missing. There, each takes the values of the
/// one that the nodes belong to, by `adopt`: then they agree on the surface to the last bit.
Solution refined(const Solution& base, Samples samples, int depth, const ck_control* control);

/// Takes the values of another part at the nodes in a box, of the levels below the `shared` first,
/// which all parts have in common.
void adopt(Solution& part, const Solution& other, size_t shared, const CellBox& box,
           const ck_control* control);

}  // namespace ck::poisson
