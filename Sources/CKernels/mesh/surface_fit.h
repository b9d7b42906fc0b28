#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ck_core.h"
#include "mesh/collapse_mesh.h"

namespace ck::texture {

/// A mesh as the caller has it.
struct InputMesh {
  const float* positions;
  size_t position_count, stride;
  const uint32_t* triangles;
  size_t triangle_count;

  Point point(size_t index) const {
    const auto* p =
        reinterpret_cast<const float*>(reinterpret_cast<const char*>(positions) + stride * index);
    return {p[0], p[1], p[2]};
  }
};

/// Moves the vertices of a simplified mesh to where its triangles are nearest to the surface
/// before, in the mean of the squares (after Hoppe et al., "Mesh optimization", SIGGRAPH 1993).
///
/// Planes touch a round surface from outside, and a collapse knows only the planes around its
/// vertex: what collapses leave is a little too small. Borders stay where they are.
class SurfaceFit {
 public:
  /// `homes` has for each vertex of `input` the vertex of `mesh` that it went into.
  SurfaceFit(const InputMesh& input, const std::vector<uint32_t>& homes, CollapseMesh* mesh);

  void run(const ck_control* control);

 private:
  /// A piece of the surface before, and where on the mesh it is nearest.
  struct Sample {
    std::array<float, 3> position;
    float area;
    std::array<float, 3> weights;  ///< of the triangle's corners
    uint32_t face;                 ///< at first a vertex of it
  };

  void add(const Point& position, double area, uint32_t home);
  /// Looks for the nearest triangle around a vertex near by, unless a sample is above its triangle.
  void find_faces(bool is_first);
  /// Puts a sample on a triangle; returns the squared distance.
  double place(Sample* s, uint32_t face) const;
  void group();
  void move_vertices();
  /// Moves a vertex unless that turns a triangle too far.
  void move(uint32_t v, const Point& p);

  CollapseMesh& mesh_;
  std::vector<Sample> samples_;
  std::vector<uint32_t> offsets_, order_;  ///< the samples of each triangle
  std::vector<Point> sides_;               ///< unit normals before the first move
  std::vector<Point> normals_;             ///< unit normals when samples were last looked for
  std::vector<uint32_t> movable_;
  std::vector<Point> starts_;  ///< of those that are movable
};

}  // namespace ck::texture
