#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "surface/points.h"
#include "surface/ray_mesh.h"

namespace {

/// Marks the triangles that the rays of one photo cross.
struct Crossings {
  RTCIntersectContext context;
  std::vector<uint8_t> crossed;
};

/// Notes the triangle and lets the ray go on.
void note(const RTCFilterFunctionNArguments* arguments) {
  auto* crossings = reinterpret_cast<Crossings*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != -1) continue;
    crossings->crossed[RTCHitN_primID(arguments->hit, arguments->N, i)] = 1;
    arguments->valid[i] = 0;
  }
}

/// Casts a ray from `center` that ends `clearance` before `point`.
void cast(RTCScene scene, Crossings& crossings, const float* center, const float* point,
          float clearance) {
  const float d[3] = {point[0] - center[0], point[1] - center[1], point[2] - center[2]};
  const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (!(length > clearance) || !std::isfinite(length)) return;
  RTCRayHit ray{};
  ray.ray.org_x = center[0];
  ray.ray.org_y = center[1];
  ray.ray.org_z = center[2];
  ray.ray.dir_x = d[0] / length;
  ray.ray.dir_y = d[1] / length;
  ray.ray.dir_z = d[2] / length;
  ray.ray.tfar = length - clearance;
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &crossings.context, &ray);
}

/// The points that each photo sees.
std::vector<std::vector<uint32_t>> points_of_photos(const uint32_t* offsets, const uint16_t* photos,
                                                    size_t point_count, size_t photo_count) {
  std::vector<std::vector<uint32_t>> points(photo_count);
  for (size_t i = 0; i < point_count; ++i) {
    for (uint32_t k = offsets[i]; k < offsets[i + 1]; ++k) {
      ck::require(photos[k] < photo_count, "a point names a photo that does not exist");
      points[photos[k]].push_back(static_cast<uint32_t>(i));
    }
  }
  return points;
}

}  // namespace

ck_status ck_seen_through(const float* positions, size_t position_stride, size_t position_count,
                          const uint32_t* triangles, size_t triangle_count, const float* points,
                          size_t point_stride, const float* clearances, size_t point_count,
                          const uint32_t* photo_offsets, const uint16_t* photos,
                          const float* centers, size_t photo_count, const ck_control* control,
                          uint16_t* counts) {
  return ck::guarded([&] {
    ck::require((counts && triangles && positions) || triangle_count == 0, "null pointer");
    std::fill(counts, counts + triangle_count, 0);
    if (triangle_count == 0 || point_count == 0) return;
    ck::require(points && clearances && photo_offsets && photos && centers, "null pointer");
    const auto device = ck::surface::make_device();
    const auto scene =
        ck::surface::make_scene(device.get(), {positions, position_stride, position_count},
                                triangles, triangle_count, note);
    const auto seen = points_of_photos(photo_offsets, photos, point_count, photo_count);
    const ck::StridedPoints p{points, point_stride, point_count};
    std::mutex mutex;
    ck::parallel_for(control, photo_count, [&](size_t photo) {
      Crossings crossings;
      rtcInitIntersectContext(&crossings.context);
      crossings.crossed.assign(triangle_count, 0);
      for (uint32_t i : seen[photo]) {
        cast(scene.get(), crossings, centers + 3 * photo, p[i], clearances[i]);
      }
      std::lock_guard<std::mutex> lock(mutex);
      for (size_t t = 0; t < triangle_count; ++t) counts[t] += crossings.crossed[t];
    });
  });
}
