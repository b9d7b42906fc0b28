#pragma once

#include "ck_bundle.h"
#include "geometry/camera_model.h"

namespace ck {

/// Limit: degrees of freedom of a pose: a rotation vector applied from the left, then the
/// translation.
constexpr int kPoseSize = 6;
/// Limit: parameters of a camera: fx (fy in constant proportion), cx, cy, k1, k2, p1, p2.
constexpr int kCameraSize = 7;

/// The reprojection error of an observation in pixels, and its derivatives.
struct Reprojection {
  Vector2 residual;
  Eigen::Matrix<double, 2, kPoseSize> by_pose;
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, kCameraSize> by_camera;
};

/// The reprojection error of `point` (world frame) at `pixel`.
inline Vector2 reprojection_error(const ck_camera& camera, const Pose& pose, const Vector3& point,
                                  const Vector2& pixel) {
  return project(camera, pose * point) - pixel;
}

/// The same with its derivatives.
Reprojection reproject(const ck_camera& camera, const Pose& pose, const Vector3& point,
                       const Vector2& pixel);

}  // namespace ck
