#include "surface/poisson/marching_cubes.h"

#include <algorithm>
#include <map>

namespace ck::poisson {

namespace {

using Edge = MarchingCubes::Edge;

/// Limit: the corners of each face, counter-clockwise seen from outside the cube.
constexpr uint8_t kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

Edge edge(uint8_t a, uint8_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The segments in which the surface crosses the faces: from where a face's border enters the
/// inside to where it leaves it, so that corners inside stay separate.
std::map<Edge, Edge> segments(int inside) {
  std::map<Edge, Edge> next;
  const auto is_inside = [&](uint8_t corner) { return (inside >> corner & 1) != 0; };
  for (const auto& face : kFaces) {
    for (size_t i = 0; i < 4; ++i) {
      // Where the border enters a run of corners inside.
      const uint8_t before = face[i], first = face[(i + 1) % 4];
      if (is_inside(before) || !is_inside(first)) continue;
      size_t last = (i + 1) % 4;
      while (is_inside(face[(last + 1) % 4])) last = (last + 1) % 4;
      next[edge(before, first)] = edge(face[last], face[(last + 1) % 4]);
    }
  }
  return next;
}

}  // namespace

const MarchingCubes& MarchingCubes::shared() {
  static const MarchingCubes cubes;
  return cubes;
}

MarchingCubes::MarchingCubes() {
  for (int inside = 0; inside < 256; ++inside) {
    std::map<Edge, Edge> next = segments(inside);
    while (!next.empty()) {
      std::vector<Edge> loop{next.begin()->first};
      while (!next.empty()) {
        const auto found = next.find(loop.back());
        const Edge to = found->second;
        next.erase(found);
        if (to == loop.front()) break;
        loop.push_back(to);
      }
      for (size_t i = 2; i < loop.size(); ++i) {
        cases_[static_cast<size_t>(inside)].push_back({loop[0], loop[i - 1], loop[i]});
      }
    }
  }
}

}  // namespace ck::poisson
