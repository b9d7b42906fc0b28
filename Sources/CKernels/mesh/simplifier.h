#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "ck_mesh.h"
#include "core/disjoint_sets.h"
#include "mesh/collapse_mesh.h"
#include "mesh/collapse_queue.h"
#include "mesh/mesh_cells.h"
#include "mesh/quadric.h"
#include "mesh/surface_fit.h"

namespace ck::mesh {

/// Quadric edge collapse (Garland and Heckbert, "Surface simplification using quadric error
/// metrics", 1997) with component removal and a final fit.
class Simplifier {
 public:
  explicit Simplifier(const InputMesh& input);

  /// Collapses the cheapest edges until at most `maximum` triangles are left; a triangle's normal
  /// may not rotate by more than the angle of `cosine`.
  ///
  /// Most collapses happen in cells of a grid, in parallel and up to a common cost, which rises
  /// from round to round; the last ones across the whole mesh.
  void run(size_t maximum, double cosine, const ck_control* control);

  /// Removes the smallest components until at most `maximum` triangles and `maximum_pieces`
  /// components are left.
  void drop_components(size_t maximum, size_t maximum_pieces);

  /// Fits the vertices to the input surface, which compensates for the shrinkage caused by the
  /// collapses.
  void fit(const ck_control* control);

  /// Writes the compacted mesh.
  void copy(ck_mutable_mesh* result) const;

 private:
  struct Vertex {
    Quadric quadric;
    double error = 0;  ///< value of the quadric at the vertex
    bool is_border = false;
  };

  /// The vertex that replaces an edge.
  struct Target {
    Quadric quadric;
    Point position;
    double error;
  };

  /// Collapses under way on one thread: in the whole mesh, or inside a cell and up to a cost.
  struct Front {
    const MeshCells* cells = nullptr;
    size_t cell = 0;
    float limit = std::numeric_limits<float>::infinity();
    CollapseMesh::Marks marks = 0;
    CollapseQueue queue;
    size_t removed = 0;  ///< triangles

    bool permits(uint32_t vertex) const { return !cells || cells->is_inside(vertex, cell); }
  };

  template <typename Body>
  void for_alive(Body&& body) const {
    for (uint32_t i = 0; i < mesh_.face_count(); ++i) {
      if (mesh_.is_alive(i)) body(i);
    }
  }

  /// Calls `body(a, b)` with a < b for the edges of a triangle; inner edges are left to one of
  /// their two triangles.
  template <typename Body>
  void for_edges(uint32_t face, Body&& body) const {
    const CollapseMesh::Face& f = mesh_.face(face);
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = f[k], b = f[(k + 1) % 3];
      if (a < b || is_border(a, b)) body(std::min(a, b), std::max(a, b));
    }
  }

  bool is_border(uint32_t a, uint32_t b) const {
    return vertices_[a].is_border && vertices_[b].is_border && mesh_.shared_faces(a, b) == 1;
  }

  void add_quadrics();
  void add_border(uint32_t a, uint32_t b, const Point& n);
  Target target_at(uint32_t a, uint32_t b, const Point& p) const;
  Target target(uint32_t a, uint32_t b) const;
  bool find_fallback(uint32_t a, uint32_t b, Target* best) const;
  float cost(uint32_t a, uint32_t b, const Target& t) const;
  float initial_limit() const;
  void run_in_cells(size_t goal, const ck_control* control);
  void run_in_cell(Front& front, size_t maximum);
  void run_everywhere(size_t maximum, const ck_control* control);
  void fill(Front& front, const ck_control* control);
  void push(Front& front, const Collapse& c, float cost);
  void push(Front& front, uint32_t first, uint32_t second);
  void collapse(Front& front, const Collapse& c);
  bool is_current(const Collapse& c) const { return versions_[c.a] + versions_[c.b] == c.version; }
  bool keeps_shape(uint32_t a, uint32_t b, const Point& p) const;
  bool keeps_orientation(uint32_t v, uint32_t other, const Point& p) const;

  InputMesh input_;
  CollapseMesh mesh_;
  std::vector<Vertex> vertices_;
  std::vector<uint32_t> versions_;  ///< how often each vertex has changed
  DisjointSets representatives_;    ///< the vertex that each was merged into
  CollapseMesh::Marks marks_ = 0;
  size_t alive_ = 0;
  double minimum_cosine_ = 0;
  bool has_collapsed_ = false;
};

}  // namespace ck::mesh
