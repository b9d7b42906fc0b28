#include <algorithm>
#include <cmath>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "surface/points.h"
#include "surface/ray_mesh.h"

namespace {

constexpr size_t kChunk = 1024;

bool in_frame(const ck_posed_photo& photo, const float* p) {
  float v[3];
  for (int r = 0; r < 3; ++r) {
    const float* row = photo.projection + 4 * r;
    v[r] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
  }
  return v[2] > 0 && v[0] >= 0 && v[1] >= 0 && v[0] < photo.width * v[2] &&
         v[1] < photo.height * v[2];
}

bool is_free(RTCScene scene, const float* origin, const float* target) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  ray.org_x = origin[0];
  ray.org_y = origin[1];
  ray.org_z = origin[2];
  ray.dir_x = target[0] - origin[0];
  ray.dir_y = target[1] - origin[1];
  ray.dir_z = target[2] - origin[2];
  ray.tfar = 1;
  ray.mask = ~0u;
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar > 0;
}

}  // namespace

ck_status ck_count_viewing_photos(const float* positions, size_t position_stride,
                                  size_t position_count, const uint32_t* triangles,
                                  size_t triangle_count, const float* points, const float* normals,
                                  size_t point_stride, size_t point_count,
                                  const ck_posed_photo* photos, size_t photo_count,
                                  float minimum_cosine, float clearance, const ck_control* control,
                                  uint16_t* counts) {
  return ck::guarded([&] {
    ck::require((counts && points && normals) || point_count == 0, "null pointer");
    ck::require((positions && triangles) || triangle_count == 0, "null pointer");
    ck::require(photos || photo_count == 0, "null pointer");
    if (point_count == 0) return;
    const auto device = ck::surface::make_device();
    const auto scene =
        ck::surface::make_scene(device.get(), {positions, position_stride, position_count},
                                triangles, triangle_count, nullptr);
    const ck::StridedPoints p{points, point_stride, point_count};
    const ck::StridedPoints n{normals, point_stride, point_count};
    ck::parallel_for(control, (point_count + kChunk - 1) / kChunk, [&](size_t chunk) {
      const size_t end = std::min(point_count, (chunk + 1) * kChunk);
      for (size_t i = chunk * kChunk; i < end; ++i) {
        counts[i] = 0;
        const float origin[3] = {p[i][0] + clearance * n[i][0], p[i][1] + clearance * n[i][1],
                                 p[i][2] + clearance * n[i][2]};
        for (size_t k = 0; k < photo_count; ++k) {
          const float* c = photos[k].center;
          const float d[3] = {c[0] - p[i][0], c[1] - p[i][1], c[2] - p[i][2]};
          const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
          const float cosine = d[0] * n[i][0] + d[1] * n[i][1] + d[2] * n[i][2];
          if (!(cosine >= minimum_cosine * length) || !in_frame(photos[k], p[i])) continue;
          if (is_free(scene.get(), origin, c)) ++counts[i];
        }
      }
    });
  });
}
