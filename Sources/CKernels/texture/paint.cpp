#include <algorithm>
#include <cmath>

#include "geometry/pinhole.h"
#include "texture/atlas.h"

namespace ck::texture {
namespace {

/// Steps of the fixed-point colors per gray level. Limit: 16 bits hold twice the range of a color,
/// with its sign.
constexpr float kSteps = 64;
/// Largest magnitude of a fixed-point color. Limit: it has 16 bits.
constexpr int kMaximumColor = 32000;
/// Samples per side with which a texel averages pixels at most. Chosen.
constexpr int kMaximumSamples = 4;

/// A color channel in fixed point.
int16_t quantized(float value) {
  constexpr float kLimit = kMaximumColor;
  return static_cast<int16_t>(std::lround(std::clamp(value * kSteps, -kLimit, kLimit)));
}

/// The mean of the values at three corners with barycentric weights.
Vec3 mix(Vec3 weights, Vec3 a, Vec3 b, Vec3 c) {
  return a * weights.x + b * weights.y + c * weights.z;
}

/// Samples the colors of one triangle from a photo. Homogeneous pixel coordinates are affine in
/// texels.
class FacePainter {
 public:
  FacePainter(const ck_atlas& atlas, const ck_view& view, const Projection& projection,
              const uint8_t* rgb, const TexelMap& map, size_t face)
      : view_(view), rgb_(rgb), map_(map) {
    for (int i = 0; i < 3; ++i) corners_[i] = projection.homogeneous(atlas.scene.corner(face, i));
    const float* c = atlas.corners.data() + 6 * face;
    const float x = (c[0] + c[2] + c[4]) / 3, y = (c[1] + c[3] + c[5]) / 3;
    const Vec2 p = pixel(x, y), right = pixel(x + 1, y) - p, down = pixel(x, y + 1) - p;
    const float reach = std::max(std::sqrt(right.x * right.x + right.y * right.y),
                                 std::sqrt(down.x * down.x + down.y * down.y));
    // A texel that spans several pixels averages a corresponding number of samples.
    samples_ = std::isfinite(reach)
                   ? std::clamp(static_cast<int>(std::ceil(reach - 0.25f)), 1, kMaximumSamples)
                   : 1;
  }

  Vec3 color(int x, int y) const {
    Vec3 sum;
    const float share = 1 / static_cast<float>(samples_);
    for (int j = 0; j < samples_; ++j) {
      for (int i = 0; i < samples_; ++i) {
        const Vec2 p = pixel(static_cast<float>(x) + (static_cast<float>(i) + 0.5f) * share,
                             static_cast<float>(y) + (static_cast<float>(j) + 0.5f) * share);
        sum += sample_rgb(rgb_, view_.camera.width, view_.camera.height, p.x, p.y);
      }
    }
    return sum * (share * share);
  }

 private:
  Vec2 pixel(float x, float y) const {
    Vec3 h = mix(map_.weights(x, y), corners_[0], corners_[1], corners_[2]);
    // Outside a triangle seen edge-on, the plane may extend behind the camera.
    if (!(h.z > 0)) h = mix({1, 1, 1}, corners_[0], corners_[1], corners_[2]);
    return {h.x / h.z, h.y / h.z};
  }

  const ck_view& view_;
  const uint8_t* rgb_;
  const TexelMap& map_;
  Vec3 corners_[3];
  int samples_ = 1;
};

/// The color offset at a corner.
Vec3 offset_at(const ck_paint& paint, int corner) {
  const float* o = paint.offsets + 3 * corner;
  return {o[0], o[1], o[2]};
}

/// Adds a color to a texel, saturating.
void add(ck_atlas& atlas, size_t texel, Vec3 color) {
  int16_t* slot = atlas.colors.data() + 3 * texel;
  const int16_t values[3] = {quantized(color.x), quantized(color.y), quantized(color.z)};
  for (int c = 0; c < 3; ++c) {
    slot[c] = static_cast<int16_t>(std::clamp(slot[c] + values[c], -kMaximumColor, kMaximumColor));
  }
}

}  // namespace
}  // namespace ck::texture

ck_status ck_atlas_paint(ck_atlas* atlas, const ck_view* view, const uint8_t* rgb,
                         const float* gain, const ck_paint* paints, size_t paint_count,
                         const ck_control* control) {
  return ck::guarded([&] {
    using ck::Vec3;
    ck::require(atlas && (!rgb || (view && gain)), "an argument is missing");
    const ck_view no_view{};
    const ck_view& source = view ? *view : no_view;
    const ck::Projection projection(source);
    constexpr size_t kChunk = 512;  // Triangles that a thread works on at a time. Chosen.
    ck::parallel_for_blocks(control, paint_count, kChunk, [&](size_t k) {
      const ck_paint& paint = paints[k];
      ck::require(paint.face < atlas->scene.triangles.size(),
                  "a paint entry refers to a triangle that does not exist");
      const ck::texture::TexelMap map(atlas->corners.data() + 6 * static_cast<size_t>(paint.face));
      if (!map.is_valid) return;
      const ck::texture::FacePainter painter(*atlas, source, projection, rgb, map, paint.face);
      atlas->for_each_texel(paint.face, [&](int x, int y, size_t texel) {
        const Vec3 w = ck::texture::TexelMap::clamped(
            map.weights(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const float weight =
            w.x * paint.weights[0] + w.y * paint.weights[1] + w.z * paint.weights[2];
        if (weight <= 0) return;
        Vec3 color =
            ck::texture::mix(w, ck::texture::offset_at(paint, 0), ck::texture::offset_at(paint, 1),
                             ck::texture::offset_at(paint, 2));
        if (rgb) {
          const Vec3 c = painter.color(x, y);
          color += Vec3{c.x * gain[0], c.y * gain[1], c.z * gain[2]};
        }
        ck::texture::add(*atlas, texel, color * weight);
      });
    });
  });
}

ck_status ck_atlas_copy_colors(const ck_atlas* atlas, const ck_control* control, uint8_t* rgb) {
  return ck::guarded([&] {
    ck::require(atlas && rgb, "an argument is missing");
    const size_t count = atlas->colors.size();
    for (size_t i = 0; i < count; ++i) {
      rgb[i] = static_cast<uint8_t>(std::clamp((atlas->colors[i] + 32) >> 6, 0, 255));
    }
    ck::texture::fill_uncovered(atlas->faces, atlas->side, 3, control, rgb);
  });
}
