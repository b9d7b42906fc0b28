#include "geometry/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "core/guard.h"
#include "core/parallel.h"

ck_ray_scene::~ck_ray_scene() {
  if (scene) rtcReleaseScene(scene);
  if (device) rtcReleaseDevice(device);
}

namespace ck {
namespace {

RTCRay make_ray(Vec3 origin, Vec3 direction, float near, float far) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = ~0u;
  return ray;
}

/// Copies the mesh and computes what is derived from it.
void copy_geometry(ck_ray_scene& scene, const ck_mesh& mesh) {
  const auto [positions, triangles, triangle_count] = mesh;
  scene.positions.resize(positions.count);
  Vec3 low, high;
  for (size_t i = 0; i < positions.count; ++i) {
    const Vec3 p = vec_at(positions, i);
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
            "a mesh vertex is not finite");
    if (i == 0) low = high = p;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    scene.positions[i] = p;
  }
  scene.diagonal = length(high - low);
  scene.triangles.resize(triangle_count);
  scene.face_normals.resize(triangle_count);
  for (size_t t = 0; t < triangle_count; ++t) {
    for (size_t i = 0; i < 3; ++i) {
      require(triangles[3 * t + i] < positions.count,
              "a triangle refers to a vertex that does not exist");
      scene.triangles[t][i] = triangles[3 * t + i];
    }
    const Vec3 a = scene.corner(t, 0);
    scene.face_normals[t] = normalized(cross(scene.corner(t, 1) - a, scene.corner(t, 2) - a));
  }
}

/// Builds the bounding volume hierarchy.
void build(ck_ray_scene& scene) {
  // With one thread the hierarchy is the same in every run.
  scene.device = rtcNewDevice("threads=1,set_affinity=0");
  if (!scene.device && rtcGetDeviceError(nullptr) == RTC_ERROR_UNSUPPORTED_CPU) {
    throw std::runtime_error("Embree does not support this processor");
  }
  if (!scene.device) throw std::bad_alloc();
  scene.scene = rtcNewScene(scene.device);
  rtcSetSceneFlags(scene.scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(scene.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree reads 16 bytes per position, so it gets a padded copy.
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                                               scene.positions.size()));
  auto* indices = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), scene.triangles.size()));
  if (!vertices || !indices) throw std::bad_alloc();
  for (const Vec3& p : scene.positions) {
    *vertices++ = p.x;
    *vertices++ = p.y;
    *vertices++ = p.z;
  }
  for (const auto& t : scene.triangles) indices = std::copy(t.begin(), t.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.scene);
  const RTCError error = rtcGetDeviceError(scene.device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree could not build the ray casting structure");
  }
}

}  // namespace

bool is_occluded(const ck_ray_scene& scene, Vec3 origin, Vec3 direction, float near, float far) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(origin, direction, near, far);
  rtcOccluded1(scene.scene, &context, &ray);
  return ray.tfar < 0;
}

bool intersect(const ck_ray_scene& scene, Vec3 origin, Vec3 direction, float near, float far,
               Hit* hit) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = make_ray(origin, direction, near, far);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene.scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  *hit = {query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v};
  return true;
}

}  // namespace ck

ck_status ck_ray_scene_create(const ck_mesh* mesh, const ck_control* control,
                              ck_ray_scene** scene) {
  return ck::guarded([&] {
    ck::require(mesh && scene, "an argument is missing");
    *scene = nullptr;
    ck::require(mesh->positions.count > 0 && mesh->triangle_count > 0, "the mesh has no triangles");
    ck::step(control, 0);
    auto result = std::make_unique<ck_ray_scene>();
    ck::copy_geometry(*result, *mesh);
    ck::build(*result);
    *scene = result.release();
  });
}

void ck_ray_scene_free(ck_ray_scene* scene) { delete scene; }

ck_status ck_find_blocked(const ck_ray_scene* scene, ck_span from, ck_span to,
                          const ck_control* control, uint8_t* is_blocked) {
  return ck::guarded([&] {
    ck::require(scene && is_blocked, "an argument is missing");
    ck::require(from.count == to.count, "the numbers of points differ");
    // Rays that a thread casts at a time. Chosen: about a millisecond.
    constexpr size_t kRays = 1024;
    // Share of the way at its start that is not tested, so that the surface there does not block
    // it. Chosen.
    constexpr float kNear = 0.001f;
    ck::parallel_for_blocks(control, from.count, kRays, [&](size_t i) {
      const ck::Vec3 origin = ck::vec_at(from, i);
      const ck::Vec3 way = ck::vec_at(to, i) - origin;
      is_blocked[i] = ck::is_occluded(*scene, origin, way, kNear, 1) ? 1 : 0;
    });
  });
}
