#include "patches/seed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <unordered_map>

namespace ck::patches {
namespace {

struct Vertex {
  float x, y, w;
};

using Face = std::array<Vertex, 3>;

/// The seeds inside the grid, at most one per pixel: the nearest to the camera.
std::vector<Vertex> vertices_of(const Grid& grid, const ck_patch_seed* seeds, size_t count,
                                double scale) {
  std::vector<Vertex> all;
  for (size_t i = 0; i < count; ++i) {
    const Vertex v{static_cast<float>(seeds[i].x * scale), static_cast<float>(seeds[i].y * scale),
                   seeds[i].inverse_depth};
    if (v.x >= 0 && v.y >= 0 && v.x < grid.width && v.y < grid.height && v.w > 0 &&
        std::isfinite(v.w))
      all.push_back(v);
  }
  const auto pixel = [&](const Vertex& v) {
    return static_cast<int>(v.y) * grid.width + static_cast<int>(v.x);
  };
  std::sort(all.begin(), all.end(), [&](const Vertex& a, const Vertex& b) {
    return std::make_tuple(pixel(a), -a.w, a.x, a.y) < std::make_tuple(pixel(b), -b.w, b.x, b.y);
  });
  all.erase(std::unique(all.begin(), all.end(),
                        [&](const Vertex& a, const Vertex& b) { return pixel(a) == pixel(b); }),
            all.end());
  return all;
}

/// The Delaunay triangulation of the vertices.
std::vector<Face> triangulate(const Grid& grid, const std::vector<Vertex>& vertices) {
  cv::Subdiv2D subdivision(cv::Rect(0, 0, grid.width + 1, grid.height + 1));
  std::unordered_map<int, Vertex> by_id;
  for (const Vertex& v : vertices) by_id[subdivision.insert({v.x, v.y})] = v;
  std::vector<int> edges;
  subdivision.getLeadingEdgeList(edges);
  std::vector<Face> faces;
  for (int edge : edges) {
    Face face;
    bool inside = true;
    for (int corner = 0; corner < 3; ++corner) {
      const auto found = by_id.find(subdivision.edgeOrg(edge));
      inside = inside && found != by_id.end();
      if (inside) face[corner] = found->second;
      edge = subdivision.getEdge(edge, cv::Subdiv2D::NEXT_AROUND_LEFT);
    }
    if (inside) faces.push_back(face);
  }
  return faces;
}

/// Twice the signed area of (a, b, p).
float cross(const Vertex& a, const Vertex& b, float x, float y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// Twice the area in pixels of the smallest triangle that is filled. Chosen: smaller ones hardly
/// cover a pixel center.
constexpr float kMinimumArea = 1e-3f;

/// Writes the plane of a triangle to the pixels it covers.
void fill(Grid& grid, const Comparison& comparison, const Face& f) {
  const float area = cross(f[0], f[1], f[2].x, f[2].y);
  if (std::fabs(area) < kMinimumArea) return;
  Plane slope;
  slope.gx = ((f[1].w - f[0].w) * (f[2].y - f[0].y) - (f[2].w - f[0].w) * (f[1].y - f[0].y)) / area;
  slope.gy = ((f[2].w - f[0].w) * (f[1].x - f[0].x) - (f[1].w - f[0].w) * (f[2].x - f[0].x)) / area;
  const auto [left, right] = std::minmax({f[0].x, f[1].x, f[2].x});
  const auto [top, bottom] = std::minmax({f[0].y, f[1].y, f[2].y});
  const float sign = area > 0 ? 1.0f : -1.0f;
  const int x0 = std::max(0, static_cast<int>(left)), y0 = std::max(0, static_cast<int>(top));
  const int x1 = std::min(grid.width - 1, static_cast<int>(right));
  const int y1 = std::min(grid.height - 1, static_cast<int>(bottom));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float px = x + 0.5f, py = y + 0.5f;
      bool inside = true;
      for (int i = 0; i < 3; ++i) inside &= sign * cross(f[i], f[(i + 1) % 3], px, py) >= 0;
      if (!inside) continue;
      Plane plane{f[0].w + slope.gx * (px - f[0].x) + slope.gy * (py - f[0].y), slope.gx, slope.gy};
      if (!is_plausible(comparison, x, y, plane)) plane = {plane.w, 0, 0};
      if (is_plausible(comparison, x, y, plane)) grid.planes[grid.index(x, y)] = plane;
    }
  }
}

}  // namespace

void seed(Grid& grid, const Comparison& comparison, const ck_patch_seed* seeds, size_t count,
          double scale) {
  const auto vertices = vertices_of(grid, seeds, count, scale);
  for (const Vertex& v : vertices) {
    const Plane plane{v.w, 0, 0};
    const int x = static_cast<int>(v.x), y = static_cast<int>(v.y);
    if (is_plausible(comparison, x, y, plane)) grid.planes[grid.index(x, y)] = plane;
  }
  if (vertices.size() < 3) return;
  for (const Face& face : triangulate(grid, vertices)) fill(grid, comparison, face);
}

}  // namespace ck::patches
