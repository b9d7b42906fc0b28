#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ck_texture.h"
#include "core/parallel.h"
#include "geometry/ray_scene.h"

namespace ck::texture {

/// Maps texels to a triangle's barycentric coordinates; affine, so it extrapolates outside the
/// triangle.
struct TexelMap {
  Vec2 origin;
  Vec2 w1, w2;
  bool is_valid = false;

  explicit TexelMap(const float* c) : origin{c[0], c[1]} {
    const Vec2 e1 = {c[2] - c[0], c[3] - c[1]}, e2 = {c[4] - c[0], c[5] - c[1]};
    const float doubled = cross(e1, e2);
    if (!(std::fabs(doubled) > 1e-9f)) return;
    is_valid = true;
    w1 = {e2.y / doubled, -e2.x / doubled};
    w2 = {-e1.y / doubled, e1.x / doubled};
  }

  /// Weights of the three corners at a texel position.
  Vec3 weights(float x, float y) const {
    const Vec2 q = Vec2{x, y} - origin;
    const float b = w1.x * q.x + w1.y * q.y, c = w2.x * q.x + w2.y * q.y;
    return {1 - b - c, b, c};
  }

  /// The weights clamped to the triangle: attributes that vary along a thin triangle must not be
  /// extrapolated into its gutter.
  static Vec3 clamped(Vec3 w) {
    w = {std::max(0.0f, w.x), std::max(0.0f, w.y), std::max(0.0f, w.z)};
    return w * (1 / (w.x + w.y + w.z));
  }
};

}  // namespace ck::texture

/// One atlas page during texturing.
struct ck_atlas {
  const ck_ray_scene& scene;
  int side;
  /// Texel coordinates of the corners, 6 floats per triangle.
  std::vector<float> corners;
  /// The triangle of each texel, −1 for none.
  std::vector<int32_t> faces;
  /// Three channels per texel, in 1/64 of a gray level.
  std::vector<int16_t> colors;
  size_t covered = 0;
  size_t overlaps = 0;
  int gutter;

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(side) + static_cast<size_t>(x);
  }

  /// Calls `visit(x, y, texel)` for the texels of a triangle, including the gutter.
  template <typename Visit>
  void for_each_texel(size_t face, Visit&& visit) const {
    const float* c = corners.data() + 6 * face;
    const auto reach = static_cast<float>(gutter + 1);
    const auto low = [&](float a, float b, float d) {
      return std::clamp(static_cast<int>(std::floor(std::min({a, b, d}) - reach)), 0, side);
    };
    const auto high = [&](float a, float b, float d) {
      return std::clamp(static_cast<int>(std::ceil(std::max({a, b, d}) + reach)), 0, side);
    };
    const int x0 = low(c[0], c[2], c[4]), x1 = high(c[0], c[2], c[4]);
    const int y0 = low(c[1], c[3], c[5]), y1 = high(c[1], c[3], c[5]);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const size_t texel = index(x, y);
        if (faces[texel] == static_cast<int32_t>(face)) visit(x, y, texel);
      }
    }
  }
};

namespace ck::texture {

/// Calls `body(face)` for all triangles of the atlas, in parallel.
template <typename Body>
void for_each_face(const ck_atlas& atlas, const ck_control* control, Body&& body) {
  constexpr size_t kChunk = 512;  // Triangles that a thread works on at a time. Chosen.
  parallel_for_blocks(control, atlas.corners.size() / 6, kChunk, body);
}

/// Fills the texels that belong to no triangle by push-pull: averages of the covered texels from
/// fine to coarse, then coarse to fine, so that mip levels of the texture contain no other color.
void fill_uncovered(const std::vector<int32_t>& faces, int side, int channels,
                    const ck_control* control, uint8_t* pixels);

}  // namespace ck::texture
