#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include "ck_bundle.h"
#include "geometry/camera_model.h"

namespace ck {

/// Parameters of a pose: quaternion x, y, z, w, then the translation.
constexpr int kPoseSize = 7;
/// Parameters of a camera: fx (fy in constant proportion), cx, cy, k1, k2, p1, p2.
constexpr int kCameraSize = 7;

/// The tangent space of a pose: a rotation vector applied from the left, then the translation.
///
/// `ReprojectionCost` differentiates with respect to the tangent directly and leaves the seventh
/// column zero, so the Jacobian of `Plus` only selects columns.
class PoseManifold final : public ceres::Manifold {
 public:
  /// `fixed_axis` 0…2 holds one component of the translation constant; −1 none.
  explicit PoseManifold(int fixed_axis) : fixed_axis_(fixed_axis) {}

  int AmbientSize() const override { return kPoseSize; }
  int TangentSize() const override { return fixed_axis_ < 0 ? 6 : 5; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;

 private:
  int fixed_axis_;
};

/// The reprojection error of one observation with analytic derivatives.
///
/// Parameter blocks: pose, point, camera.
class ReprojectionCost final : public ceres::SizedCostFunction<2, kPoseSize, 3, kCameraSize> {
 public:
  /// `aspect` is fy / fx.
  ReprojectionCost(double x, double y, double aspect) : pixel_(x, y), aspect_(aspect) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Vector2 pixel_;
  double aspect_;
};

/// Deviation of the camera parameters from their priors, in standard deviations.
class CameraPriorCost final : public ceres::SizedCostFunction<5, kCameraSize> {
 public:
  explicit CameraPriorCost(const ck_camera_prior& prior);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  double mean_[5];
  /// Reciprocal standard deviations; 0 without prior.
  double weight_[5];
};

}  // namespace ck
