#include "texture/atlas.h"

#include <cmath>
#include <memory>

#include "core/parallel.h"
#include "core/progress.h"

namespace ck::texture {
namespace {

/// Tolerance of the barycentric weights of a texel center in a triangle, so that none is missed
/// between two triangles, and weight from which a center counts as covered twice. Chosen: above the
/// rounding of single precision, and well above the tolerance.
constexpr float kInsideTolerance = 1e-4f, kOverlapWeight = 1e-2f;
/// Number of rows that a thread works on at a time. Chosen: about a millisecond.
constexpr size_t kRows = 64;

/// Assigns every texel whose center lies in a triangle to it; of several triangles the first one
/// keeps it.
void rasterize(ck_atlas& atlas) {
  const auto side = static_cast<float>(atlas.side);
  for (size_t f = 0; f < atlas.corners.size() / 6; ++f) {
    const float* c = atlas.corners.data() + 6 * f;
    const TexelMap map(c);
    if (!map.is_valid) continue;
    const auto range = [&](float a, float b, float d) {
      const float low = std::clamp(std::min({a, b, d}) - 0.5f, 0.0f, side);
      const float high = std::clamp(std::max({a, b, d}) + 0.5f, 0.0f, side);
      return std::pair{static_cast<int>(low), static_cast<int>(std::ceil(high))};
    };
    const auto [x0, x1] = range(c[0], c[2], c[4]);
    const auto [y0, y1] = range(c[1], c[3], c[5]);
    for (int y = y0; y < std::min(y1, atlas.side); ++y) {
      for (int x = x0; x < std::min(x1, atlas.side); ++x) {
        const Vec3 w = map.weights(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        if (w.x < -kInsideTolerance || w.y < -kInsideTolerance || w.z < -kInsideTolerance) continue;
        int32_t& slot = atlas.faces[atlas.index(x, y)];
        if (slot < 0) {
          slot = static_cast<int32_t>(f);
          ++atlas.covered;
        } else if (w.x > kOverlapWeight && w.y > kOverlapWeight && w.z > kOverlapWeight) {
          ++atlas.overlaps;
        }
      }
    }
  }
}

/// Grows charts by one texel into free space.
void grow(ck_atlas& atlas, const ck_control* control) {
  const std::vector<int32_t> before = atlas.faces;
  const int side = atlas.side;
  parallel_for_blocks(control, static_cast<size_t>(side), kRows, [&](size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < side; ++x) {
      const size_t texel = atlas.index(x, y);
      if (before[texel] >= 0) continue;
      const auto at = [&](int nx, int ny) {
        return nx < 0 || ny < 0 || nx >= side || ny >= side ? -1 : before[atlas.index(nx, ny)];
      };
      const int32_t around[8] = {at(x - 1, y),     at(x + 1, y),     at(x, y - 1),
                                 at(x, y + 1),     at(x - 1, y - 1), at(x + 1, y - 1),
                                 at(x - 1, y + 1), at(x + 1, y + 1)};
      for (const int32_t face : around) {
        if (face < 0) continue;
        atlas.faces[texel] = face;
        break;
      }
    }
  });
}

}  // namespace
}  // namespace ck::texture

ck_status ck_atlas_create(const ck_ray_scene* scene, const float* corners, size_t triangle_count,
                          int32_t side, int32_t gutter, const ck_control* control,
                          ck_atlas** atlas) {
  return ck::guarded([&] {
    ck::require(scene && corners && atlas, "an argument is missing");
    *atlas = nullptr;
    ck::require(side > 0 && side <= 32768 && gutter >= 0, "the side of a texture is out of range");
    ck::require(triangle_count == scene->triangles.size(),
                "texture coordinates and triangles differ in number");
    for (size_t i = 0; i < 6 * triangle_count; ++i) {
      ck::require(std::isfinite(corners[i]), "a texture coordinate is not finite");
    }
    ck::step(control, 0);
    const size_t texels = static_cast<size_t>(side) * static_cast<size_t>(side);
    std::unique_ptr<ck_atlas> result(new ck_atlas{
        *scene, side, std::vector<float>(corners, corners + 6 * triangle_count),
        std::vector<int32_t>(texels, -1), std::vector<int16_t>(3 * texels, 0), 0, 0, gutter});
    ck::texture::rasterize(*result);
    for (int i = 0; i < gutter; ++i) {
      const ck::ProgressPart part(control, 0.5, 0.5);
      ck::texture::grow(*result, part.control());
    }
    *atlas = result.release();
  });
}

void ck_atlas_free(ck_atlas* atlas) { delete atlas; }

size_t ck_atlas_covered_count(const ck_atlas* atlas) { return atlas ? atlas->covered : 0; }

size_t ck_atlas_overlap_count(const ck_atlas* atlas) { return atlas ? atlas->overlaps : 0; }
