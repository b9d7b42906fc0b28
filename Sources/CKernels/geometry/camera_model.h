#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "ck_camera.h"

namespace ck {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

/// Smallest depth, in world units, of a point in front of a camera. Chosen: below that of any
/// scene.
constexpr double kMinimumDepth = 1e-9;

/// `cameraFromWorld` with the rotation as a matrix.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3 translation = Vector3::Zero();

  Vector3 operator*(const Vector3& point) const { return rotation * point + translation; }
  /// The camera center in the world frame.
  Vector3 center() const { return -rotation.transpose() * translation; }
};

/// The rotation of a pose, normalized to unit length.
inline Eigen::Quaterniond quaternion_of(const ck_pose& pose) {
  return Eigen::Quaterniond(pose.qw, pose.qx, pose.qy, pose.qz).normalized();
}

/// Converts a pose of the C interface.
inline Pose pose_from(const ck_pose& pose) {
  return {quaternion_of(pose).toRotationMatrix(), Vector3(pose.tx, pose.ty, pose.tz)};
}

/// Converts to a pose of the C interface.
inline ck_pose pose_to(const Eigen::Quaterniond& q, const Vector3& t) {
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

inline ck_pose pose_to(const Pose& pose) {
  return pose_to(Eigen::Quaterniond(pose.rotation).normalized(), pose.translation);
}

/// The rotation by a rotation vector in radians (exponential map).
inline Eigen::Quaterniond exponential(const Vector3& omega) {
  const double angle = omega.norm();
  const double factor = angle > 1e-8 ? std::sin(angle / 2) / angle : 0.5 - angle * angle / 48;
  return Eigen::Quaterniond(std::cos(angle / 2), factor * omega.x(), factor * omega.y(),
                            factor * omega.z());
}

/// Applies the lens distortion to normalized image coordinates.
inline Vector2 distort(const ck_camera& c, const Vector2& p) {
  const double r2 = p.squaredNorm();
  const double radial = 1 + r2 * (c.k1 + r2 * c.k2);
  const double xy = p.x() * p.y();
  return {p.x() * radial + 2 * c.p1 * xy + c.p2 * (r2 + 2 * p.x() * p.x()),
          p.y() * radial + c.p1 * (r2 + 2 * p.y() * p.y()) + 2 * c.p2 * xy};
}

/// The Jacobian of `distort` with respect to the point.
inline Eigen::Matrix2d distort_jacobian(const ck_camera& c, const Vector2& p) {
  const double r2 = p.squaredNorm();
  const double radial = 1 + r2 * (c.k1 + r2 * c.k2);
  const double slope = 2 * (c.k1 + 2 * c.k2 * r2);
  const double cross = slope * p.x() * p.y() + 2 * c.p1 * p.x() + 2 * c.p2 * p.y();
  Eigen::Matrix2d j;
  j << radial + slope * p.x() * p.x() + 2 * c.p1 * p.y() + 6 * c.p2 * p.x(), cross, cross,
      radial + slope * p.y() * p.y() + 6 * c.p1 * p.y() + 2 * c.p2 * p.x();
  return j;
}

/// Projects a point in the camera frame to a pixel.
inline Vector2 project(const ck_camera& c, const Vector3& point) {
  const Vector2 d = distort(c, point.head<2>() / point.z());
  return {c.fx * d.x() + c.cx, c.fy * d.y() + c.cy};
}

/// The Jacobian of `project` with respect to the point.
inline Eigen::Matrix<double, 2, 3> project_jacobian(const ck_camera& c, const Vector3& point) {
  const double inverse = 1 / point.z();
  const Vector2 p = point.head<2>() * inverse;
  Eigen::Matrix2d d = distort_jacobian(c, p);
  d.row(0) *= c.fx * inverse;
  d.row(1) *= c.fy * inverse;
  Eigen::Matrix<double, 2, 3> j;
  j.leftCols<2>() = d;
  j.col(2) = -d * p;
  return j;
}

/// Newton's method on the distortion: largest number of steps, smallest determinant, and the
/// squared step at which it stops. Chosen: it converges to double precision in a few steps.
constexpr int kUndistortionSteps = 20;
constexpr double kMinimumUndistortionDeterminant = 1e-9, kUndistortionTolerance = 1e-24;

/// The point at depth 1 on the viewing ray of a pixel; inverts the distortion by Newton's method.
inline Vector2 unproject(const ck_camera& c, double x, double y) {
  const Vector2 target((x - c.cx) / c.fx, (y - c.cy) / c.fy);
  if (c.k1 == 0 && c.k2 == 0 && c.p1 == 0 && c.p2 == 0) return target;
  Vector2 p = target;
  for (int i = 0; i < kUndistortionSteps; ++i) {
    const Eigen::Matrix2d j = distort_jacobian(c, p);
    const double determinant = j.determinant();
    if (!(std::abs(determinant) > kMinimumUndistortionDeterminant)) break;
    const Vector2 r = distort(c, p) - target;
    const Vector2 step =
        Vector2(j(1, 1) * r.x() - j(0, 1) * r.y(), j(0, 0) * r.y() - j(1, 0) * r.x()) / determinant;
    p -= step;
    if (step.squaredNorm() < kUndistortionTolerance) break;
  }
  return p;
}

}  // namespace ck
