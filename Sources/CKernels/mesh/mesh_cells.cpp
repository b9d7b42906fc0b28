#include "mesh/mesh_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"

namespace ck::mesh {
namespace {

/// Of n³ cells, a closed surface crosses about this many times n²: a square across the grid crosses
/// n², a sphere that fills it 1.5 π n² (an area of π n² at a mean of 1.5 cells per unit of area).
/// Chosen: a value between them.
constexpr double kCrossedCells = 3;
/// Number of vertices that a thread works on at a time. Chosen: about a millisecond.
constexpr size_t kBlock = 16384;

}  // namespace

MeshCells::MeshCells(const CollapseMesh& mesh, size_t alive, size_t faces_per_cell, bool is_shifted,
                     const ck_control* control) {
  find_cells(mesh, alive, faces_per_cell, is_shifted, control);
  find_homes(mesh, control);
  group_faces(mesh);
}

void MeshCells::find_cells(const CollapseMesh& mesh, size_t alive, size_t faces_per_cell,
                           bool is_shifted, const ck_control* control) {
  Point low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_used(v)) continue;
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], mesh.point(v)[k]);
      high[k] = std::max(high[k], mesh.point(v)[k]);
    }
  }
  const double across =
      std::ceil(std::sqrt(double(alive) / (kCrossedCells * double(faces_per_cell))));
  const Point extent = high - low;
  const double size = std::max({extent[0], extent[1], extent[2], 1e-300}) / std::max(1.0, across);
  const double shift = is_shifted ? 0.5 : 0;
  const auto side = size_t(across) + 2;
  cell_count_ = side * side * side;
  cells_.resize(mesh.vertex_count());
  parallel_for_blocks(control, cells_.size(), kBlock, [&](size_t v) {
    const Point offset = mesh.point(uint32_t(v)) - low;
    size_t cell = 0;
    for (size_t k = 0; k < 3; ++k) {
      const double position = std::clamp(offset[k] / size + shift, 0.0, double(side - 1));
      cell = cell * side + size_t(position);
    }
    cells_[v] = uint32_t(cell);
  });
}

void MeshCells::find_homes(const CollapseMesh& mesh, const ck_control* control) {
  homes_.resize(mesh.vertex_count());
  parallel_for_blocks(control, homes_.size(), kBlock, [&](size_t i) {
    const auto v = uint32_t(i);
    const bool is_inside = mesh.all_faces(v, [&](uint32_t f) {
      const CollapseMesh::Face& face = mesh.face(f);
      return cells_[face[0]] == cells_[v] && cells_[face[1]] == cells_[v] &&
             cells_[face[2]] == cells_[v];
    });
    homes_[v] = is_inside ? cells_[v] : CollapseMesh::kNone;
  });
}

void MeshCells::group_faces(const CollapseMesh& mesh) {
  const auto for_inner_faces = [&](auto&& body) {
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
      if (!mesh.is_alive(f)) continue;
      const CollapseMesh::Face& face = mesh.face(f);
      const uint32_t cell = cells_[face[0]];
      if (cells_[face[1]] == cell && cells_[face[2]] == cell) body(cell, f);
    }
  };
  starts_.assign(cell_count_ + 1, 0);
  for_inner_faces([&](uint32_t cell, uint32_t) { ++starts_[cell + 1]; });
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  faces_.resize(starts_.back());
  std::vector<size_t> next(starts_.begin(), starts_.end() - 1);
  for_inner_faces([&](uint32_t cell, uint32_t f) { faces_[next[cell]++] = f; });
}

}  // namespace ck::mesh
