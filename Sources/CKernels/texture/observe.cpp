#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "geometry/pinhole.h"
#include "geometry/ray_scene.h"

namespace ck::texture {
namespace {

/// The depth where there is no surface.
constexpr float kFar = std::numeric_limits<float>::max();

// Lengths are in diagonals of the surface's bounding box.
/// Offset in front of the triangle at which a ray to the camera starts; at most halfway to the
/// camera. Chosen: by trial.
constexpr float kRayOffset = 2e-4f;
/// Largest depth difference at which a surface counts as that of the triangle, not as an occluder
/// or background. Chosen: by trial.
constexpr float kDepthTolerance = 0.004f;
/// Position between a triangle's centroid (0) and its corners (1) at which rays start. Chosen: by
/// trial.
constexpr float kCornerShare = 0.95f;

/// The projection of a vertex.
struct Corner {
  Vec2 pixel;
  float depth = 0;
};

/// The luminance of all pixels, 0…255.
std::vector<float> luminance_of(const uint8_t* rgb, size_t pixels) {
  std::vector<float> gray(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    gray[i] = 0.299f * rgb[3 * i] + 0.587f * rgb[3 * i + 1] + 0.114f * rgb[3 * i + 2];
  }
  return gray;
}

/// Calls `visit(x, y, w1, w2)` for all pixels whose center lies in the triangle.
template <typename Visit>
void rasterize(const std::array<Vec2, 3>& p, int width, int height, Visit&& visit) {
  const float doubled = cross(p[1] - p[0], p[2] - p[0]);
  if (!(std::fabs(doubled) > 1e-12f)) return;
  const auto clamp_to = [](float v, int limit) {
    return static_cast<int>(std::clamp(v, 0.0f, static_cast<float>(limit)));
  };
  const int x0 = clamp_to(std::floor(std::min({p[0].x, p[1].x, p[2].x}) - 0.5f), width);
  const int x1 = clamp_to(std::ceil(std::max({p[0].x, p[1].x, p[2].x}) + 0.5f), width);
  const int y0 = clamp_to(std::floor(std::min({p[0].y, p[1].y, p[2].y}) - 0.5f), height);
  const int y1 = clamp_to(std::ceil(std::max({p[0].y, p[1].y, p[2].y}) + 0.5f), height);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const Vec2 q = Vec2{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f} - p[0];
      const float w1 = cross(q, p[2] - p[0]) / doubled;
      const float w2 = cross(p[1] - p[0], q) / doubled;
      if (w1 >= 0 && w2 >= 0 && w1 + w2 <= 1) visit(x, y, w1, w2);
    }
  }
}

/// A depth buffer at reduced resolution with the smallest and the largest depth around each pixel.
struct DepthRange {
  static constexpr int kShrink = 2;  // Side in pixels of a pixel of the buffer. Chosen.
  int width, height;
  std::vector<float> nearest;
  /// `kFar` if any pixel around shows no surface.
  std::vector<float> farthest;

  DepthRange(const ck_ray_scene& scene, const std::vector<Corner>& corners, const ck_view& view,
             int radius)
      : width(view.camera.width / kShrink + 1),
        height(view.camera.height / kShrink + 1),
        nearest(static_cast<size_t>(width) * static_cast<size_t>(height), kFar) {
    for (const auto& t : scene.triangles) {
      const Corner &a = corners[t[0]], &b = corners[t[1]], &c = corners[t[2]];
      if (a.depth <= 0 || b.depth <= 0 || c.depth <= 0) continue;
      const std::array<Vec2, 3> p = {a.pixel * (1.0f / kShrink), b.pixel * (1.0f / kShrink),
                                     c.pixel * (1.0f / kShrink)};
      rasterize(p, width, height, [&](int x, int y, float w1, float w2) {
        float& slot = nearest[index(x, y)];
        slot = std::min(slot, a.depth * (1 - w1 - w2) + b.depth * w1 + c.depth * w2);
      });
    }
    farthest = nearest;
    spread(&nearest, radius, [](float a, float b) { return std::min(a, b); });
    spread(&farthest, radius, [](float a, float b) { return std::max(a, b); });
  }

  /// Index into the buffers of a pixel of the view.
  size_t at(Vec2 pixel) const {
    return index(std::clamp(static_cast<int>(pixel.x) / kShrink, 0, width - 1),
                 std::clamp(static_cast<int>(pixel.y) / kShrink, 0, height - 1));
  }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }

  /// Replaces each pixel by the extreme of the square that extends `radius` around it, rows first.
  template <typename Extreme>
  void spread(std::vector<float>* values, int radius, Extreme&& extreme) const {
    for (const bool along_rows : {true, false}) {
      const std::vector<float> from = *values;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          float& to = (*values)[index(x, y)];
          for (int d = -radius; d <= radius; ++d) {
            const int sx = along_rows ? std::clamp(x + d, 0, width - 1) : x;
            const int sy = along_rows ? y : std::clamp(y + d, 0, height - 1);
            to = extreme(to, from[index(sx, sy)]);
          }
        }
      }
    }
  }
};

/// Measures the triangles of a scene in one view.
class Observer {
 public:
  Observer(const ck_ray_scene& scene, const ck_view& view, const uint8_t* rgb, const uint8_t* mask,
           const ck_observe_options& options)
      : scene_(scene),
        view_(view),
        rgb_(rgb),
        mask_(mask),
        options_(options),
        projection_(view),
        corners_(project(scene, projection_)),
        gray_(luminance_of(
            rgb, static_cast<size_t>(view.camera.width) * static_cast<size_t>(view.camera.height))),
        radius_(std::max(1, static_cast<int>(std::ceil(options.margin / DepthRange::kShrink)))),
        depths_(scene, corners_, view, radius_) {}

  /// Measures one triangle; its area is 0 if it is not visible.
  ck_face_observation observe(size_t t) const {
    ck_face_observation result{};
    const Vec3 centroid = scene_.centroid(t);
    const Vec3 to_camera = projection_.center - centroid;
    const float distance = length(to_camera);
    if (!(distance > 0)) return result;
    const float cosine = dot(scene_.face_normals[t], to_camera) / distance;
    if (!(cosine >= options_.minimum_cosine)) return result;
    std::array<Corner, 3> corners;
    for (size_t i = 0; i < 3; ++i) {
      corners[i] = corners_[scene_.triangles[t][i]];
      if (!is_inside(corners[i])) return result;
    }
    if (is_masked(corners)) return result;
    if (is_hidden(t, centroid, distance)) return result;
    const std::array<Vec2, 3> p = {corners[0].pixel, corners[1].pixel, corners[2].pixel};
    result.area = std::fabs(cross(p[1] - p[0], p[2] - p[0])) / 2;
    result.cosine = cosine;
    check_surroundings(corners, cosine, &result);
    measure(p, &result);
    return result;
  }

 private:
  static std::vector<Corner> project(const ck_ray_scene& scene, const Projection& projection) {
    std::vector<Corner> corners(scene.positions.size());
    for (size_t i = 0; i < corners.size(); ++i) {
      const Vec3 h = projection.homogeneous(scene.positions[i]);
      if (h.z > 0) corners[i] = {{h.x / h.z, h.y / h.z}, h.z};
    }
    return corners;
  }

  bool is_inside(const Corner& c) const {
    const float margin = options_.margin;
    return c.depth > 0 && c.pixel.x >= margin && c.pixel.y >= margin &&
           c.pixel.x <= static_cast<float>(view_.camera.width) - margin &&
           c.pixel.y <= static_cast<float>(view_.camera.height) - margin;
  }

  /// Whether a corner or the centroid would take color from masked pixels: colors are interpolated
  /// between four pixels.
  bool is_masked(const std::array<Corner, 3>& c) const {
    if (!mask_) return false;
    const Vec2 middle = (c[0].pixel + c[1].pixel + c[2].pixel) * (1.0f / 3);
    for (const Vec2 p : {c[0].pixel, c[1].pixel, c[2].pixel, middle}) {
      if (is_masked_around(p, 0.5f)) return true;
    }
    return false;
  }

  bool is_masked_around(Vec2 pixel, float reach) const {
    for (const Vec2 way : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{1, 1}}) {
      const Vec2 p = pixel + way * reach;
      if (mask_[index(static_cast<int>(p.x), static_cast<int>(p.y))] < 128) return true;
    }
    return false;
  }

  bool is_hidden(size_t t, Vec3 centroid, float distance) const {
    const float near = std::min(0.5f, kRayOffset * scene_.diagonal / distance);
    for (int i = 0; i < 4; ++i) {
      // Corners are moved inwards, so that adjacent triangles do not occlude them.
      const Vec3 p = i == 3 ? centroid : centroid + (scene_.corner(t, i) - centroid) * kCornerShare;
      if (is_occluded(scene_, p, projection_.center - p, near, 1)) return true;
    }
    return false;
  }

  /// Sets `is_clear` and `is_interior` from the depths and the mask around the corners.
  void check_surroundings(const std::array<Corner, 3>& corners, float cosine,
                          ck_face_observation* result) const {
    result->is_clear = result->is_interior = true;
    const float slope = std::sqrt(std::max(0.0f, 1 - cosine * cosine)) / cosine;
    for (const Corner& c : corners) {
      const float pixel = c.depth / static_cast<float>(view_.camera.fx);
      const float reach = static_cast<float>((radius_ + 1) * DepthRange::kShrink) * pixel;
      // Depth variation that the slope of the surface itself explains.
      const float tolerance = reach * (2 * slope + 2) + kDepthTolerance * scene_.diagonal;
      const size_t place = depths_.at(c.pixel);
      if (depths_.nearest[place] < c.depth - tolerance) result->is_clear = false;
      if (depths_.farthest[place] > c.depth + tolerance) result->is_interior = false;
      if (mask_ && is_masked_around(c.pixel, options_.margin)) result->is_interior = false;
    }
  }

  /// Averages color and luminance gradient over the triangle.
  void measure(const std::array<Vec2, 3>& p, ck_face_observation* result) const {
    Vec3 sum;
    float gradient = 0;
    int count = 0;
    rasterize(p, view_.camera.width, view_.camera.height, [&](int x, int y, float, float) {
      const uint8_t* pixel = rgb_ + 3 * index(x, y);
      sum += {static_cast<float>(pixel[0]), static_cast<float>(pixel[1]),
              static_cast<float>(pixel[2])};
      gradient += gradient_at(x, y);
      ++count;
    });
    if (count < 2) {
      const Vec2 middle = (p[0] + p[1] + p[2]) * (1.0f / 3);
      sum = sample_rgb(rgb_, view_.camera.width, view_.camera.height, middle.x, middle.y);
      gradient = gradient_at(static_cast<int>(middle.x), static_cast<int>(middle.y));
      count = 1;
    }
    const float share = 1 / static_cast<float>(count);
    result->color[0] = sum.x * share;
    result->color[1] = sum.y * share;
    result->color[2] = sum.z * share;
    result->gradient = gradient * share;
  }

  size_t index(int x, int y) const {
    return static_cast<size_t>(std::clamp(y, 0, view_.camera.height - 1)) *
               static_cast<size_t>(view_.camera.width) +
           static_cast<size_t>(std::clamp(x, 0, view_.camera.width - 1));
  }

  float gradient_at(int x, int y) const {
    const float dx = gray_[index(x + 1, y)] - gray_[index(x - 1, y)];
    const float dy = gray_[index(x, y + 1)] - gray_[index(x, y - 1)];
    return std::sqrt(dx * dx + dy * dy) / 2;
  }

  const ck_ray_scene& scene_;
  const ck_view& view_;
  const uint8_t* rgb_;
  const uint8_t* mask_;
  const ck_observe_options& options_;
  Projection projection_;
  std::vector<Corner> corners_;
  std::vector<float> gray_;
  int radius_;
  DepthRange depths_;
};

}  // namespace
}  // namespace ck::texture

ck_status ck_observe_faces(const ck_ray_scene* scene, const ck_view* view, const uint8_t* rgb,
                           const uint8_t* mask, const ck_observe_options* options,
                           const ck_control* control, ck_face_observation* observations) {
  return ck::guarded([&] {
    ck::require(scene && view && rgb && options && observations, "an argument is missing");
    const ck_camera& camera = view->camera;
    ck::require(camera.width > 1 && camera.height > 1 && camera.fx > 0 && camera.fy > 0,
                "a view has no pixels or no focal length");
    ck::step(control, 0);
    const ck::texture::Observer observer(*scene, *view, rgb, mask, *options);
    constexpr size_t kChunk = 4096;  // Triangles that a thread works on at a time. Chosen.
    ck::parallel_for_blocks(control, scene->triangles.size(), kChunk,
                            [&](size_t t) { observations[t] = observer.observe(t); });
  });
}
