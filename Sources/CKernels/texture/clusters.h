#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/vec.h"

namespace ck::texture {

/// Two triangles that share an edge, and its length.
struct DualEdge {
  uint32_t a, b;
  float length;
};

/// A triangle mesh as charting sees it.
struct ChartMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<Vec3> normals;
  std::vector<float> areas;
  std::vector<float> perimeters;
  /// Sorted by a, then b. Edges of more than two triangles connect none of them.
  std::vector<DualEdge> edges;

  ChartMesh(const float* positions, size_t position_count, size_t stride, const uint32_t* triangles,
            size_t triangle_count);
};

/// A direction that all normals of a chart are within `angle` of.
struct Cone {
  Vec3 axis;
  float angle = 0;
};

/// The smallest cone around two cones.
Cone joined(const Cone& a, const Cone& b);

/// Takes triangles out of charts in which they would lie on others, and gives them charts of their
/// own; keeps `charts` connected and `axes` in step.
void separate_overlaps(const ChartMesh& mesh, std::vector<int32_t>* charts,
                       std::vector<Vec3>* axes);

}  // namespace ck::texture
