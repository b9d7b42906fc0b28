#include <algorithm>
#include <cmath>

#include "core/guard.h"
#include "texture/chart_mesh.h"

namespace ck::texture {
namespace {

struct HalfEdge {
  uint32_t low, high, face;
  bool operator<(const HalfEdge& o) const {
    if (low != o.low) return low < o.low;
    if (high != o.high) return high < o.high;
    return face < o.face;
  }
  bool same_edge(const HalfEdge& o) const { return low == o.low && high == o.high; }
};

}  // namespace

ChartMesh::ChartMesh(const ck_mesh& mesh) {
  const size_t position_count = mesh.positions.count, triangle_count = mesh.triangle_count;
  positions.resize(position_count);
  for (size_t i = 0; i < position_count; ++i) positions[i] = vec_at(mesh.positions, i);
  triangles.resize(triangle_count);
  normals.resize(triangle_count);
  areas.resize(triangle_count);
  perimeters.resize(triangle_count);
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * triangle_count);
  for (uint32_t t = 0; t < triangle_count; ++t) {
    for (uint32_t i = 0; i < 3; ++i) {
      triangles[t][i] = mesh.triangles[3 * t + i];
      require(triangles[t][i] < position_count,
              "a triangle refers to a vertex that does not exist");
    }
    const auto [a, b, c] = triangles[t];
    const Vec3 n = cross(positions[b] - positions[a], positions[c] - positions[a]);
    areas[t] = length(n) / 2;
    normals[t] = normalized(n);
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      perimeters[t] += length(positions[p] - positions[q]);
      half_edges.push_back({std::min(p, q), std::max(p, q), t});
    }
  }
  std::sort(half_edges.begin(), half_edges.end());
  for (size_t i = 0; i < half_edges.size();) {
    size_t end = i + 1;
    while (end < half_edges.size() && half_edges[i].same_edge(half_edges[end])) ++end;
    if (end - i == 2 && half_edges[i].face != half_edges[i + 1].face) {
      edges.push_back({half_edges[i].face, half_edges[i + 1].face,
                       length(positions[half_edges[i].low] - positions[half_edges[i].high])});
    }
    i = end;
  }
  std::sort(edges.begin(), edges.end(), [](const DualEdge& a, const DualEdge& b) {
    return a.a != b.a ? a.a < b.a : a.b < b.b;
  });
}

Cone joined(const Cone& a, const Cone& b) {
  if (dot(a.axis, a.axis) == 0) return b;
  if (dot(b.axis, b.axis) == 0) return a;
  const float between = std::acos(std::clamp(dot(a.axis, b.axis), -1.0f, 1.0f));
  if (between + b.angle <= a.angle) return a;
  if (between + a.angle <= b.angle) return b;
  const float angle = (between + a.angle + b.angle) / 2;
  const float turn = angle - a.angle;
  const float sine = std::sin(between);
  if (sine < 1e-4f) return {a.axis, angle};
  return {normalized(a.axis * (std::sin(between - turn) / sine) + b.axis * (std::sin(turn) / sine)),
          angle};
}

}  // namespace ck::texture
