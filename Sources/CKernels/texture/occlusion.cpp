#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "texture/ray_scene.h"

namespace ck::texture {
namespace {

/// Directions of the upper hemisphere, denser at the top as the cosine, evenly spread: Hammersley
/// points on the disc, lifted onto the sphere.
std::vector<Vec3> cosine_directions(size_t count) {
  std::vector<Vec3> directions(count);
  for (size_t i = 0; i < count; ++i) {
    double radical = 0, digit = 0.5;
    for (size_t n = i; n > 0; n >>= 1, digit *= 0.5) radical += (n & 1) ? digit : 0;
    const double r2 = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double r = std::sqrt(r2), angle = 2 * 3.14159265358979323846 * radical;
    directions[i] = {static_cast<float>(r * std::cos(angle)),
                     static_cast<float>(r * std::sin(angle)),
                     static_cast<float>(std::sqrt(1 - r2))};
  }
  return directions;
}

}  // namespace
}  // namespace ck::texture

ck_status ck_occlusion(const ck_ray_scene* scene, const float* positions, size_t position_stride,
                       const float* normals, size_t normal_stride, size_t count, size_t rays,
                       float maximum_distance, const ck_control* control, float* openness) {
  return ck::guarded([&] {
    using ck::texture::Vec3;
    ck::require(scene && positions && normals && openness && rays > 0, "an argument is missing");
    const std::vector<Vec3> directions = ck::texture::cosine_directions(rays);
    const float lift = 5e-4f * scene->diagonal;
    constexpr size_t kChunk = 256;
    ck::parallel_for(control, (count + kChunk - 1) / kChunk, [&](size_t chunk) {
      const size_t end = std::min(count, (chunk + 1) * kChunk);
      for (size_t i = chunk * kChunk; i < end; ++i) {
        const Vec3 n = ck::texture::normalized(ck::texture::vec_at(normals, normal_stride, i));
        Vec3 u, v;
        ck::texture::frame_around(n, &u, &v);
        const Vec3 origin = ck::texture::vec_at(positions, position_stride, i) + n * lift;
        size_t open = 0;
        for (const Vec3& d : directions) {
          const Vec3 direction = u * d.x + v * d.y + n * d.z;
          open += !ck::texture::is_occluded(*scene, origin, direction, lift, maximum_distance);
        }
        openness[i] = static_cast<float>(open) / static_cast<float>(rays);
      }
    });
  });
}
