#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ck_core.h"
#include "mesh/collapse_mesh.h"

namespace ck::mesh {

/// The triangles of a mesh in the cells of a cubic grid: parts that threads may simplify at the
/// same time.
///
/// The grid follows from the mesh alone, and so does the result.
class MeshCells {
 public:
  /// Cells have about `faces_per_cell` of the `alive` triangles. With `is_shifted`, they are
  /// shifted by half of their size along all axes, so that the edges between cells get inside.
  MeshCells(const CollapseMesh& mesh, size_t alive, size_t faces_per_cell, bool is_shifted,
            const ck_control* control);

  size_t count() const { return starts_.size() - 1; }

  size_t face_count(size_t cell) const { return starts_[cell + 1] - starts_[cell]; }
  bool is_empty(size_t cell) const { return face_count(cell) == 0; }

  /// Calls `body(face)` for the triangles of a cell.
  template <typename Body>
  void for_faces(size_t cell, Body&& body) const {
    for (size_t i = starts_[cell]; i < starts_[cell + 1]; ++i) body(faces_[i]);
  }

  /// Whether a vertex and all its neighbors are in this cell.
  bool is_inside(uint32_t vertex, size_t cell) const { return homes_[vertex] == cell; }

 private:
  void find_cells(const CollapseMesh& mesh, size_t alive, size_t faces_per_cell, bool is_shifted,
                  const ck_control* control);
  void find_homes(const CollapseMesh& mesh, const ck_control* control);
  void group_faces(const CollapseMesh& mesh);

  /// The cell of each vertex; then the cell that contains it and its neighbors, or kNone.
  std::vector<uint32_t> cells_, homes_;
  size_t cell_count_ = 0;
  /// The triangles of each cell: those of which all vertices are in it.
  std::vector<size_t> starts_;
  std::vector<uint32_t> faces_;
};

}  // namespace ck::mesh
