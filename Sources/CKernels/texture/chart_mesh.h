#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ck_mesh.h"
#include "geometry/vec.h"

namespace ck::texture {

/// An edge of the dual graph: two triangles and the length of their common edge.
struct DualEdge {
  uint32_t a, b;
  float length;
};

/// A triangle mesh with the quantities that charting uses.
struct ChartMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<Vec3> normals;
  std::vector<float> areas;
  std::vector<float> perimeters;
  /// Sorted by a, then b. Non-manifold edges connect no triangles.
  std::vector<DualEdge> edges;

  explicit ChartMesh(const ck_mesh& mesh);
};

/// A cone of normals: all are within `angle` radians of the axis.
struct Cone {
  Vec3 axis;
  float angle = 0;
};

/// The smallest cone around two cones.
Cone joined(const Cone& a, const Cone& b);

/// Moves triangles that overlap others in the projection of their chart to new charts; keeps charts
/// connected and `axes` consistent with `charts`.
void separate_overlaps(const ChartMesh& mesh, std::vector<int32_t>* charts,
                       std::vector<Vec3>* axes);

}  // namespace ck::texture
