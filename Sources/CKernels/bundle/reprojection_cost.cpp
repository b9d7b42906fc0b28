#include "bundle/reprojection_cost.h"

#include <algorithm>

namespace ck {

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  double full[6] = {delta[0], delta[1], delta[2], 0, 0, 0};
  for (int axis = 0, column = 3; axis < 3; ++axis) {
    if (axis != fixed_axis_) full[3 + axis] = delta[column++];
  }
  const Eigen::Quaterniond q(x[3], x[0], x[1], x[2]);
  const Eigen::Quaterniond r = (exponential({full[0], full[1], full[2]}) * q).normalized();
  const double result[kPoseSize] = {r.x(),          r.y(),          r.z(),         r.w(),
                                    x[4] + full[3], x[5] + full[4], x[6] + full[5]};
  std::copy(result, result + kPoseSize, x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double*, double* jacobian) const {
  const int size = TangentSize();
  std::fill(jacobian, jacobian + kPoseSize * size, 0.0);
  for (int i = 0, column = 0; i < 6; ++i) {
    if (i - 3 != fixed_axis_ || i < 3) jacobian[i * size + column++] = 1;
  }
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const Eigen::Quaterniond a(y[3], y[0], y[1], y[2]), b(x[3], x[0], x[1], x[2]);
  const Eigen::AngleAxisd difference(a * b.conjugate());
  const Vector3 omega = difference.angle() * difference.axis();
  std::copy(omega.data(), omega.data() + 3, y_minus_x);
  for (int axis = 0, column = 3; axis < 3; ++axis) {
    if (axis != fixed_axis_) y_minus_x[column++] = y[4 + axis] - x[4 + axis];
  }
  return true;
}

bool PoseManifold::MinusJacobian(const double*, double* jacobian) const {
  const int size = TangentSize();
  std::fill(jacobian, jacobian + kPoseSize * size, 0.0);
  for (int i = 0, row = 0; i < 6; ++i) {
    if (i - 3 != fixed_axis_ || i < 3) jacobian[kPoseSize * row++ + i] = 1;
  }
  return true;
}

bool ReprojectionCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const double* pose = parameters[0];
  const double* intrinsics = parameters[2];
  const ck_camera camera = {intrinsics[0],
                            aspect_ * intrinsics[0],
                            intrinsics[1],
                            intrinsics[2],
                            intrinsics[3],
                            intrinsics[4],
                            intrinsics[5],
                            intrinsics[6],
                            0,
                            0};
  const Eigen::Quaterniond rotation(pose[3], pose[0], pose[1], pose[2]);
  const Vector3 rotated = rotation * Vector3(parameters[1][0], parameters[1][1], parameters[1][2]);
  const Vector3 point = rotated + Vector3(pose[4], pose[5], pose[6]);
  const Vector2 p = point.head<2>() / point.z();
  const Vector2 d = distort(camera, p);
  residuals[0] = camera.fx * d.x() + camera.cx - pixel_.x();
  residuals[1] = camera.fy * d.y() + camera.cy - pixel_.y();
  if (!jacobians) return true;

  const Eigen::Matrix<double, 2, 3> by_point = project_jacobian(camera, point);
  if (jacobians[0]) {
    Eigen::Map<Eigen::Matrix<double, 2, kPoseSize, Eigen::RowMajor>> j(jacobians[0]);
    for (int row = 0; row < 2; ++row) {
      j.block<1, 3>(row, 0) = rotated.cross(by_point.row(row).transpose()).transpose();
    }
    j.block<2, 3>(0, 3) = by_point;
    j.col(6).setZero();
  }
  if (jacobians[1]) {
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> j(jacobians[1]);
    j.noalias() = by_point * rotation.toRotationMatrix();
  }
  if (jacobians[2]) {
    Eigen::Map<Eigen::Matrix<double, 2, kCameraSize, Eigen::RowMajor>> j(jacobians[2]);
    const double r2 = p.squaredNorm(), xy = 2 * p.x() * p.y();
    j << d.x(), 1, 0, r2 * p.x(), r2 * r2 * p.x(), xy, r2 + 2 * p.x() * p.x(), aspect_ * d.y(), 0,
        1, r2 * p.y(), r2 * r2 * p.y(), r2 + 2 * p.y() * p.y(), xy;
    j.block<1, 4>(0, 3) *= camera.fx;
    j.block<1, 4>(1, 3) *= camera.fy;
  }
  return true;
}

CameraPriorCost::CameraPriorCost(const ck_camera_prior& prior)
    : mean_{prior.focal_length, prior.cx, prior.cy, 0, 0} {
  const double deviations[5] = {prior.focal_length * prior.focal_deviation,
                                prior.principal_point_deviation, prior.principal_point_deviation,
                                prior.radial_deviation, prior.radial_deviation};
  for (int i = 0; i < 5; ++i) weight_[i] = deviations[i] > 0 ? 1 / deviations[i] : 0;
}

bool CameraPriorCost::Evaluate(double const* const* parameters, double* residuals,
                               double** jacobians) const {
  for (int i = 0; i < 5; ++i) residuals[i] = weight_[i] * (parameters[0][i] - mean_[i]);
  if (jacobians && jacobians[0]) {
    std::fill(jacobians[0], jacobians[0] + 5 * kCameraSize, 0.0);
    for (int i = 0; i < 5; ++i) jacobians[0][i * kCameraSize + i] = weight_[i];
  }
  return true;
}

}  // namespace ck
