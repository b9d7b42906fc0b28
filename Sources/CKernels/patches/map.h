#pragma once

#include <Eigen/Core>

#include "ck_patches.h"

namespace ck::patches {

using Vector2 = Eigen::Vector2f;
using Vector3 = Eigen::Vector3f;

/// A patch map with its camera ready for use.
struct Map {
  explicit Map(const ck_patch_map& map);

  /// The patch of the cell, or null where it has none or one of this cost or a higher.
  const ck_patch* patch(int x, int y, float threshold) const {
    const ck_patch& p = at(x, y);
    return p.inverse_depth > 0 && p.cost < threshold ? &p : nullptr;
  }

  const ck_patch& at(int x, int y) const {
    return raw->patches[static_cast<size_t>(y) * width + x];
  }

  bool is_accepted(int x, int y) const {
    return raw->states && raw->states[static_cast<size_t>(y) * width + x] != ck_patch_rejected;
  }

  /// The viewing ray of a pixel at depth 1, in the camera's frame.
  Vector3 ray(float u, float v) const { return {(u - cx) / fx, (v - cy) / fy, 1}; }

  Vector3 to_camera(const Vector3& world) const { return rotation * world + translation; }
  Vector3 to_world(const Vector3& camera) const {
    return rotation.transpose() * (camera - translation);
  }

  Vector2 project(const Vector3& camera) const {
    return {camera.x() / camera.z() * fx + cx, camera.y() / camera.z() * fy + cy};
  }

  /// The unit normal in the world that points to the camera's side.
  Vector3 normal(const ck_patch& patch, int x, int y) const;

  const ck_patch_map* raw;
  int width, height;
  float fx, fy, cx, cy;
  Eigen::Matrix3f rotation;
  Vector3 translation;
};

/// What another view says about a point.
struct Confirmation {
  enum Kind { kNothing, kAgrees, kSeesThrough } kind = kNothing;
  /// The cell of the other view.
  int x = 0, y = 0;
  /// The other view's own point.
  Vector3 point = Vector3::Zero();
  /// Pixels of the reference between the point and the other view's.
  float distance = 0;
};

/// Asks `other` about the point of `reference` at (x + ½, y + ½).
Confirmation confirm(const Map& reference, const Map& other, int x, int y, const Vector3& world,
                     const Vector3& normal, const ck_patch_filter_options& options);

/// The point of a cell in the world.
inline Vector3 point_of(const Map& map, const ck_patch& patch, int x, int y) {
  return map.to_world(map.ray(x + 0.5f, y + 0.5f) / patch.inverse_depth);
}

}  // namespace ck::patches
