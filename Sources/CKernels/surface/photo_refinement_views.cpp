#include <algorithm>
#include <cmath>

#include "surface/photo_refinement.h"

namespace ck::surface {
namespace {

/// The depth where there is no surface.
constexpr float kFar = std::numeric_limits<float>::infinity();
/// Depth tolerance of the occlusion test, in pixel footprints. Chosen.
constexpr float kTolerance = 5;
/// Tolerance of the barycentric weights of a pixel center in a triangle, so that no pixel falls
/// between two triangles. Chosen: above the rounding of single precision.
constexpr float kInsideTolerance = 1e-5f;

/// Calls `visit(x, y, depth)` for all pixels whose center lies in the triangle `p` (x, y, 1 /
/// depth).
template <typename Visit>
void rasterize(const std::array<Vec3, 3>& p, int width, int height, Visit&& visit) {
  const Vec3 &a = p[0], &b = p[1], &c = p[2];
  const float doubled = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::fabs(doubled) > 1e-9f)) return;
  const auto whole = [](float v, int limit) {
    return static_cast<int>(std::clamp(std::floor(v), -1.0f, static_cast<float>(limit)));
  };
  const int x0 = std::max(0, whole(std::min({a.x, b.x, c.x}) + 0.5f, width));
  const int x1 = std::min(width - 1, whole(std::max({a.x, b.x, c.x}) - 0.5f, width));
  const int y0 = std::max(0, whole(std::min({a.y, b.y, c.y}) + 0.5f, height));
  const int y1 = std::min(height - 1, whole(std::max({a.y, b.y, c.y}) - 0.5f, height));
  const float inverse = 1 / doubled;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float dx = static_cast<float>(x) + 0.5f - a.x, dy = static_cast<float>(y) + 0.5f - a.y;
      const float w1 = (dx * (c.y - a.y) - dy * (c.x - a.x)) * inverse;
      const float w2 = ((b.x - a.x) * dy - (b.y - a.y) * dx) * inverse;
      if (w1 < -kInsideTolerance || w2 < -kInsideTolerance || w1 + w2 > 1 + kInsideTolerance) {
        continue;
      }
      visit(x, y, 1 / (a.z + w1 * (b.z - a.z) + w2 * (c.z - a.z)));
    }
  }
}

/// The projections of all vertices as x, y in shrunk pixels and 1 / depth.
std::vector<Vec3> project_all(const RefinedMesh& mesh, const RefinementView& view, int shrink) {
  std::vector<Vec3> projected(mesh.positions.size());
  const float scale = 1.0f / static_cast<float>(shrink);
  for (size_t v = 0; v < projected.size(); ++v) {
    const Vec3 p = view.project(mesh.positions[v]);
    projected[v] = {p.x * scale, p.y * scale, 1 / p.z};
  }
  return projected;
}

}  // namespace

SurfaceImage::SurfaceImage(const RefinedMesh& mesh, const RefinementView& view, int shrink) {
  const auto projected = project_all(mesh, view, shrink);
  const int full_width = view.view.camera.width / shrink + (shrink > 1 ? 1 : 0);
  const int full_height = view.view.camera.height / shrink + (shrink > 1 ? 1 : 0);
  float low_x = static_cast<float>(full_width), low_y = static_cast<float>(full_height);
  float high_x = 0, high_y = 0;
  for (const Vec3& p : projected) {
    if (!(p.z > 0)) continue;
    low_x = std::min(low_x, p.x);
    low_y = std::min(low_y, p.y);
    high_x = std::max(high_x, p.x);
    high_y = std::max(high_y, p.y);
  }
  x0 = static_cast<int>(std::max(0.0f, low_x));
  y0 = static_cast<int>(std::max(0.0f, low_y));
  width = std::max(0, std::min(full_width, static_cast<int>(std::min(high_x, 1e6f)) + 1) - x0);
  height = std::max(0, std::min(full_height, static_cast<int>(std::min(high_y, 1e6f)) + 1) - y0);
  triangles.assign(static_cast<size_t>(width) * static_cast<size_t>(height), kNone);
  depths.assign(triangles.size(), kFar);
  const Vec3 corner = {static_cast<float>(x0), static_cast<float>(y0), 0};
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const std::array<Vec3, 3> p = {projected[v[0]] - corner, projected[v[1]] - corner,
                                   projected[v[2]] - corner};
    if (!(p[0].z > 0 && p[1].z > 0 && p[2].z > 0)) continue;
    rasterize(p, width, height, [&](int x, int y, float depth) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      if (!(depth < depths[i])) return;
      depths[i] = depth;
      triangles[i] = t;
    });
  }
}

RefinementView::RefinementView(const ck_view& view, const uint8_t* rgb, const uint8_t* mask)
    : view(view), projection(view) {
  const size_t pixels =
      static_cast<size_t>(view.camera.width) * static_cast<size_t>(view.camera.height);
  luminance.resize(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const float value = 0.299f * rgb[3 * i] + 0.587f * rgb[3 * i + 1] + 0.114f * rgb[3 * i + 2];
    luminance[i] = static_cast<uint8_t>(value + 0.5f);
  }
  const size_t rows = static_cast<size_t>(view.camera.height / kShrink + 1);
  nearest.assign(shrunk_width() * rows, kFar);
  for (size_t i = 0; mask && i < pixels; ++i) {
    const size_t x = i % static_cast<size_t>(view.camera.width),
                 y = i / static_cast<size_t>(view.camera.width);
    if (mask[i] < 128) nearest[y / kShrink * shrunk_width() + x / kShrink] = 0;
  }
}

void RefinementView::find_depths(const RefinedMesh& mesh) {
  const SurfaceImage image(mesh, *this, kShrink);
  const int columns = static_cast<int>(shrunk_width());
  const int rows = view.camera.height / kShrink + 1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float depth = image.depths[static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                                       static_cast<size_t>(x)];
      if (depth == kFar) continue;
      const int cx = image.x0 + x, cy = image.y0 + y;
      for (int ny = std::max(0, cy - 1); ny <= std::min(rows - 1, cy + 1); ++ny) {
        for (int nx = std::max(0, cx - 1); nx <= std::min(columns - 1, cx + 1); ++nx) {
          float& slot = nearest[static_cast<size_t>(ny) * shrunk_width() + static_cast<size_t>(nx)];
          slot = std::min(slot, depth);
        }
      }
    }
  }
}

Vec3 RefinementView::project(Vec3 p) const {
  const Vec3 h = projection.homogeneous(p);
  return {h.x / h.z, h.y / h.z, h.z};
}

bool RefinementView::sees(Vec3 p, float margin) const {
  if (!(p.z > 0 && p.x >= margin && p.y >= margin &&
        p.x < static_cast<float>(view.camera.width) - margin &&
        p.y < static_cast<float>(view.camera.height) - margin)) {
    return false;
  }
  const size_t x = static_cast<size_t>(p.x) / kShrink, y = static_cast<size_t>(p.y) / kShrink;
  return p.z < nearest[y * shrunk_width() + x] + kTolerance * footprint(p.z);
}

}  // namespace ck::surface
