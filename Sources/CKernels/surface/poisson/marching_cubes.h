#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ck::poisson {

/// The triangles of marching cubes (Lorensen and Cline, SIGGRAPH 1987) for a cube whose corner i
/// has the coordinates of the bits of i. A vertex is an edge, a pair of corners.
///
/// On a face with two opposite corners inside, these are separated, whichever cube the face is seen
/// from, so that adjacent cubes agree.
class MarchingCubes {
 public:
  using Edge = std::array<uint8_t, 2>;
  using Triangle = std::array<Edge, 3>;

  static const MarchingCubes& shared();

  /// `inside` has the bits of the corners inside; triangles are counter-clockwise seen from
  /// outside.
  const std::vector<Triangle>& triangles(int inside) const {
    return cases_[static_cast<size_t>(inside)];
  }

 private:
  MarchingCubes();
  std::array<std::vector<Triangle>, 256> cases_;
};

}  // namespace ck::poisson
