#include <algorithm>
#include <cmath>
#include <vector>

#include "core/disjoint_sets.h"
#include "texture/chart_mesh.h"

namespace ck::texture {
namespace {

/// Largest number of rounds of splitting overlapping charts. Chosen.
constexpr int kMaximumRounds = 6;
/// Cosine between a triangle's normal and the axis of its chart below which the triangle counts as
/// back-facing or almost parallel to the axis. Chosen: by trial.
constexpr float kObliqueCosine = 0.1f;

/// Cells of the grid per side of a square with the mean area of a triangle, and largest number per
/// side of the chart. Chosen.
constexpr float kCellsPerTriangleSide = 4, kMaximumCells = 2048;
/// Barycentric weight of all corners from which a cell's center lies well inside a triangle.
/// Chosen: above the rounding of single precision.
constexpr float kInsideWeight = 1e-3f;

/// The triangles of each chart, in ascending order.
std::vector<std::vector<uint32_t>> faces_by_chart(const std::vector<int32_t>& charts,
                                                  size_t count) {
  std::vector<std::vector<uint32_t>> faces(count);
  for (uint32_t t = 0; t < charts.size(); ++t) faces[static_cast<size_t>(charts[t])].push_back(t);
  return faces;
}

/// Finds the triangles that overlap others when a chart is projected along its axis.
class OverlapFinder {
 public:
  OverlapFinder(const ChartMesh& mesh, const std::vector<uint32_t>& faces, Vec3 axis)
      : mesh_(mesh), faces_(faces) {
    frame_around(axis, &u_, &v_);
    float area = 0;
    low_ = high_ = project(mesh.triangles[faces[0]][0]);
    for (const uint32_t f : faces) {
      area += mesh.areas[f];
      for (const uint32_t i : mesh.triangles[f]) {
        const Vec2 p = project(i);
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
      }
    }
    const float cell = std::sqrt(std::max(area, 1e-30f) / static_cast<float>(faces.size())) /
                       kCellsPerTriangleSide;
    const Vec2 extent = high_ - low_;
    cell_ = std::max({cell, extent.x / kMaximumCells, extent.y / kMaximumCells, 1e-12f});
    width_ = static_cast<int>(extent.x / cell_) + 2;
    height_ = static_cast<int>(extent.y / cell_) + 2;
  }

  /// The triangles that overlap one with priority, or are back-facing, in ascending order.
  std::vector<uint32_t> find() const {
    std::vector<uint8_t> taken(static_cast<size_t>(width_) * static_cast<size_t>(height_), 0);
    // Triangles that face the plane have priority, oblique ones are split off.
    std::vector<uint32_t> order = faces_;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      const float da = dot(mesh_.normals[a], axis()), db = dot(mesh_.normals[b], axis());
      return da != db ? da > db : a < b;
    });
    std::vector<uint32_t> overlapping;
    std::vector<size_t> cells;
    for (const uint32_t f : order) {
      cells.clear();
      bool is_free = true;
      const bool is_upright = collect(f, &cells);
      for (const size_t c : cells) is_free = is_free && !taken[c];
      if (!is_free || !is_upright) {
        overlapping.push_back(f);
      } else {
        for (const size_t c : cells) taken[c] = 1;
      }
    }
    std::sort(overlapping.begin(), overlapping.end());
    return overlapping;
  }

 private:
  Vec3 axis() const { return cross(u_, v_); }

  Vec2 project(uint32_t vertex) const {
    return {dot(mesh_.positions[vertex], u_), dot(mesh_.positions[vertex], v_)};
  }

  /// Collects the cells whose center lies well inside the triangle; false if it is back-facing.
  bool collect(uint32_t face, std::vector<size_t>* cells) const {
    Vec2 p[3];
    for (size_t i = 0; i < 3; ++i) {
      p[i] = (project(mesh_.triangles[face][i]) - low_) * (1 / cell_);
    }
    const float doubled = cross(p[1] - p[0], p[2] - p[0]);
    if (mesh_.areas[face] > 0 && doubled < 0) return false;
    if (!(doubled > 1e-6f)) return true;
    const int x0 = static_cast<int>(std::min({p[0].x, p[1].x, p[2].x}));
    const int x1 = static_cast<int>(std::max({p[0].x, p[1].x, p[2].x}));
    const int y0 = static_cast<int>(std::min({p[0].y, p[1].y, p[2].y}));
    const int y1 = static_cast<int>(std::max({p[0].y, p[1].y, p[2].y}));
    for (int y = y0; y <= std::min(y1, height_ - 1); ++y) {
      for (int x = x0; x <= std::min(x1, width_ - 1); ++x) {
        const Vec2 q = Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f} - p[0];
        const float w1 = cross(q, p[2] - p[0]) / doubled;
        const float w2 = cross(p[1] - p[0], q) / doubled;
        if (w1 > kInsideWeight && w2 > kInsideWeight && w1 + w2 < 0.999f) {
          cells->push_back(static_cast<size_t>(y) * static_cast<size_t>(width_) +
                           static_cast<size_t>(x));
        }
      }
    }
    return true;
  }

  const ChartMesh& mesh_;
  const std::vector<uint32_t>& faces_;
  Vec3 u_, v_;
  Vec2 low_, high_;
  float cell_ = 1;
  int width_ = 0, height_ = 0;
};

/// Splits charts into connected components; each keeps the axis of its chart.
void split_components(const ChartMesh& mesh, std::vector<int32_t>* charts,
                      std::vector<Vec3>* axes) {
  DisjointSets components(charts->size());
  for (const DualEdge& e : mesh.edges) {
    if ((*charts)[e.a] == (*charts)[e.b]) components.join(e.a, e.b);
  }
  std::vector<int32_t> ids(charts->size(), -1);
  std::vector<Vec3> directions;
  std::vector<int32_t> result(charts->size());
  for (uint32_t t = 0; t < charts->size(); ++t) {
    int32_t& id = ids[components.root(t)];
    if (id < 0) {
      id = static_cast<int32_t>(directions.size());
      directions.push_back((*axes)[static_cast<size_t>((*charts)[t])]);
    }
    result[t] = id;
  }
  *charts = std::move(result);
  *axes = std::move(directions);
}

/// Whether a triangle is back-facing or almost parallel to the projection axis.
bool is_oblique(const ChartMesh& mesh, uint32_t face, Vec3 axis) {
  const Vec3 n = mesh.normals[face];
  return dot(n, n) > 0 && dot(n, axis) < kObliqueCosine;
}

}  // namespace

void separate_overlaps(const ChartMesh& mesh, std::vector<int32_t>* charts,
                       std::vector<Vec3>* axes) {
  size_t first = 0;
  for (int round = 0; round < kMaximumRounds && first < axes->size(); ++round) {
    const auto faces = faces_by_chart(*charts, axes->size());
    const size_t count = axes->size();
    for (size_t c = first; c < count; ++c) {
      if (faces[c].size() < 2) continue;
      const Vec3 axis = (*axes)[c];
      int32_t spill = -1;
      for (const uint32_t f : OverlapFinder(mesh, faces[c], axis).find()) {
        const bool has_own_axis = is_oblique(mesh, f, axis);
        // Triangles split off stay together for now; the last round makes each a chart.
        const bool is_alone = has_own_axis || round + 1 == kMaximumRounds;
        if (is_alone || spill < 0) axes->push_back(has_own_axis ? mesh.normals[f] : axis);
        const auto last = static_cast<int32_t>(axes->size() - 1);
        if (!is_alone && spill < 0) spill = last;
        (*charts)[f] = is_alone ? last : spill;
      }
    }
    first = count;
  }
  split_components(mesh, charts, axes);
}

}  // namespace ck::texture
