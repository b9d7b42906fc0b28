#pragma once

#include <memory>
#include <vector>

#include "bundle/layout.h"
#include "bundle/reduced_system.h"

namespace ck {

/// A change of the parameters: 6 values per free pose and 7 per free camera, then 3 per point.
struct BundleStep {
  Eigen::VectorXd cameras;
  std::vector<Vector3> points;
};

/// The damped normal equations of a bundle, linearized at given parameters.
///
/// Points are eliminated, each independently of the others (Schur complement; Triggs et al.,
/// section 6.1). All sums have an order that does not depend on the number of threads: a block is
/// computed by one thread, and sums over points are made in chunks of fixed size.
class NormalEquations {
 public:
  NormalEquations(const ck_bundle& bundle, const BundleLayout& layout, double huber_width,
                  const ck_control* control);

  /// The robust cost: half of the sum of the Huber losses of the reprojection errors and of the
  /// squared deviations from the priors.
  double cost(const BundleParameters& parameters) const;

  /// Computes residuals and derivatives, weighted for the Huber loss.
  void linearize(const BundleParameters& parameters);

  /// The largest absolute component of the gradient of the cost; available after `reduce`.
  double gradient_norm() const { return gradient_norm_; }

  /// Computes the reduced camera system. Damping: this share of each diagonal element is added to
  /// it.
  void reduce(double damping, ReducedSystem& system);

  /// Completes the solution of the reduced system with the changes of the points.
  BundleStep complete(const ReducedSystem& system, const Eigen::VectorXd& cameras) const;

  /// The decrease of the cost that the linearized equations predict for a step.
  double predicted_decrease(const ReducedSystem& system, const BundleStep& step) const;

 private:
  using Prior = Eigen::Matrix<double, kCameraSize, 1>;
  using ByCamera = Eigen::Matrix<double, 2, kCameraSize>;
  struct CameraSum;
  /// The residual of an observation and its derivatives by the pose and the point, weighted.
  struct Term {
    Vector2 residual;
    Eigen::Matrix<double, 2, kPoseSize> by_pose;
    Eigen::Matrix<double, 2, 3> by_point;
  };
  /// Poses that a thread adds at a time.
  struct PoseUnit {
    size_t begin, end;
  };

  template <typename Sum>
  double sum_over_points(Sum&& sum) const;
  void link(size_t point);
  double eliminate_points(double damping);
  std::vector<PoseUnit> pose_units() const;
  double add_pose(size_t pose, double damping, ReducedSystem& system) const;
  void read_ahead(size_t i, size_t end) const;
  void add_observation(size_t k, const Eigen::Matrix<double, 2, 3>& by_point, size_t pose,
                       ReducedSystem& system) const;
  double add_cameras(double damping, ReducedSystem& system) const;
  CameraSum camera_sum(size_t camera, size_t chunk, const ReducedSystem& system) const;
  Prior deviations(const ck_camera& camera, size_t block) const;

  const BundleLayout& layout_;
  double huber_width_;
  const ck_control quiet_;
  /// Means and reciprocal standard deviations of the parameters of free cameras; 0 without a prior.
  std::vector<Prior> prior_means_, prior_weights_;
  /// One for each observation; `linearize` writes them first. The derivatives by the camera, which
  /// the sums over pairs of observations don't need, are apart, so that less memory is read.
  std::unique_ptr<Term[]> terms_;
  std::unique_ptr<ByCamera[]> by_camera_;
  /// The derivatives by the point and by the camera, multiplied and summed, for each link.
  std::vector<Eigen::Matrix<double, 3, kCameraSize>> links_;
  /// The deviations from the priors, in standard deviations.
  std::vector<Prior> prior_residuals_;
  /// For each free point, its inverted block of the normal equations and its part of the gradient.
  std::vector<Eigen::Matrix3d> inverses_;
  std::vector<Vector3> gradients_;
  double gradient_norm_ = 0;
};

}  // namespace ck
