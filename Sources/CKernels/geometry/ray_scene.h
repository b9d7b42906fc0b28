#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <vector>

#include "ck_rays.h"
#include "geometry/vec.h"

/// A triangle mesh with its bounding volume hierarchy.
struct ck_ray_scene {
  std::vector<ck::Vec3> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
  /// Unit normals of the triangles; zero for degenerate ones.
  std::vector<ck::Vec3> face_normals;
  /// Length of the diagonal of the bounding box.
  float diagonal = 0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ck_ray_scene() = default;
  ck_ray_scene(const ck_ray_scene&) = delete;
  ck_ray_scene& operator=(const ck_ray_scene&) = delete;
  ~ck_ray_scene();

  /// The position of corner 0…2 of a triangle.
  ck::Vec3 corner(size_t triangle, int i) const {
    return positions[triangles[triangle][static_cast<size_t>(i)]];
  }
  ck::Vec3 centroid(size_t t) const {
    return (corner(t, 0) + corner(t, 1) + corner(t, 2)) * (1.0f / 3);
  }
};

namespace ck {

/// Intersection of a ray with the surface.
struct Hit {
  float distance = 0;
  uint32_t triangle = 0;
  /// Barycentric coordinates of the triangle's second and third corner.
  float u = 0, v = 0;
};

/// Whether the ray hits the surface between `near` and `far` times `direction`.
bool is_occluded(const ck_ray_scene& scene, Vec3 origin, Vec3 direction, float near, float far);

/// The first intersection between `near` and `far` times `direction`; false if there is none.
bool intersect(const ck_ray_scene& scene, Vec3 origin, Vec3 direction, float near, float far,
               Hit* hit);

}  // namespace ck
