#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ck_core.h"
#include "core/span.h"
#include "mesh/collapse_mesh.h"

namespace ck::mesh {

/// The caller's mesh.
struct InputMesh {
  Strided<float> positions;
  const uint32_t* triangles;
  size_t triangle_count;

  Point point(size_t index) const {
    const float* p = positions[index];
    return {p[0], p[1], p[2]};
  }
};

/// Moves the vertices of a simplified mesh to minimize the mean squared distance of its triangles
/// to the original surface (after Hoppe et al., "Mesh optimization", SIGGRAPH 1993).
///
/// Planes touch a convex surface from outside, and a collapse knows only the planes around its
/// vertex: the simplified surface is slightly too small. Boundaries are not moved.
class SurfaceFit {
 public:
  /// `representatives` holds for each vertex of `input` the vertex of `mesh` that it was merged
  /// into, `marks` the last mark in `mesh`.
  SurfaceFit(const InputMesh& input, const std::vector<uint32_t>& representatives,
             CollapseMesh* mesh, CollapseMesh::Marks marks);

  void run(const ck_control* control);

 private:
  /// A sample of the original surface and its nearest point on the mesh.
  struct Sample {
    std::array<float, 3> position;
    float area;
    std::array<float, 3> weights;  ///< barycentric
    uint32_t face;                 ///< initially the index of a vertex
  };

  void add(const Point& position, double area, uint32_t representative);
  /// Searches for the nearest triangle around a nearby vertex, except for samples whose projection
  /// lies inside their triangle.
  void find_faces(bool is_first, const ck_control* control);
  /// The same for one sample.
  void find_face(bool is_first, Sample& s) const;
  /// Projects a sample onto a triangle; returns the squared distance.
  double place(Sample* s, uint32_t face) const;
  /// Groups the samples by triangle and updates the normals.
  void group();
  /// Sorts the movable vertices by color, such that no two neighbors have the same.
  void color(CollapseMesh::Marks marks);
  /// Calls `body(i)` for the movable vertices, color by color: the vertices of a color do not
  /// depend on each other.
  template <typename Body>
  void for_movable(const ck_control* control, Body&& body);
  /// Moves a vertex to the position where the samples are nearest to the planes of its triangles,
  /// in the least squares sense.
  void fit_vertex(uint32_t v);
  /// Moves a vertex unless that rotates a triangle too far.
  void move(uint32_t v, const Point& p);

  CollapseMesh& mesh_;
  std::vector<Sample> samples_;
  std::vector<uint32_t> offsets_, order_;  ///< the samples of each triangle
  std::vector<Point> initial_normals_;     ///< unit normals before the first move
  std::vector<Point> normals_;             ///< unit normals when the samples were last projected
  std::vector<uint32_t> movable_;
  std::vector<size_t> colors_;  ///< the first movable vertex of each color, and the end
  std::vector<Point> starts_;   ///< initial positions of the movable vertices
};

}  // namespace ck::mesh
