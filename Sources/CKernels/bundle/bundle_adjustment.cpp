#include <ceres/ceres.h>

#include <array>
#include <memory>
#include <vector>

#include "bundle/reprojection_cost.h"
#include "ck_bundle.h"
#include "core/guard.h"
#include "core/span.h"

namespace ck {
namespace {

static_assert(kCameraSize == kPoseSize, "cameras and poses share one type of parameter block");

/// Ceres stops at a gradient with a smaller maximum norm, or a smaller relative change of the
/// parameters.
constexpr double kGradientTolerance = 1e-10, kParameterTolerance = 1e-10;
/// Largest number of conjugate gradient iterations per step.
constexpr int kMaximumLinearIterations = 100;

/// Reports the progress of Ceres and passes cancellation to it.
class ControlCallback final : public ceres::IterationCallback {
 public:
  ControlCallback(const ck_control* control, int maximum_iterations)
      : control_(control), maximum_iterations_(maximum_iterations) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    try {
      step(control_, std::min(1.0, summary.iteration / double(std::max(1, maximum_iterations_))));
    } catch (const Canceled&) {
      canceled = true;
      return ceres::SOLVER_ABORT;
    }
    return ceres::SOLVER_CONTINUE;
  }

  bool canceled = false;

 private:
  const ck_control* control_;
  int maximum_iterations_;
};

/// The parameter blocks of a bundle and the Ceres problem over them.
class Adjustment {
 public:
  Adjustment(ck_bundle& bundle, const ck_bundle_options& options)
      : bundle_(bundle), options_(options), loss_(options.huber_width), problem_(settings()) {
    load();
    add_observations();
    constrain();
  }

  ceres::Solver::Summary solve(ControlCallback& callback) {
    ceres::Solver::Options solver;
    solver.max_num_iterations = options_.maximum_iterations;
    solver.function_tolerance = options_.function_tolerance;
    solver.gradient_tolerance = kGradientTolerance;
    solver.parameter_tolerance = kParameterTolerance;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    solver.callbacks.push_back(&callback);
    solver.linear_solver_ordering = ordering_;
    solver.linear_solver_type = free_photos_ <= options_.dense_photo_limit ? ceres::DENSE_SCHUR
                                : free_photos_ <= options_.direct_photo_limit
                                    ? ceres::SPARSE_SCHUR
                                    : ceres::ITERATIVE_SCHUR;
    // CHOLMOD rounds as the BLAS that happens to be installed.
    solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    solver.preconditioner_type = ceres::SCHUR_JACOBI;
    solver.max_linear_solver_iterations = kMaximumLinearIterations;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem_, &summary);
    return summary;
  }

  /// False if adjusted cameras are not finite or have a focal length of 0 or less.
  bool is_valid() const {
    bool valid = true;
    for (size_t i = 0; i < blocks_.size(); ++i) {
      valid = valid && std::isfinite(blocks_[i][0] + blocks_[i][4]);
      valid = valid && (i >= bundle_.camera_count || blocks_[i][0] > 0);
    }
    return valid;
  }

  /// Writes the adjusted values back.
  void store() {
    for (size_t i = 0; i < bundle_.camera_count; ++i) {
      if (!used_cameras_[i]) continue;
      const double* c = camera(i);
      ck_camera& adjusted = bundle_.cameras[i];
      adjusted = {c[0], c[0] * aspects_[i], c[1],           c[2], c[3], c[4], c[5],
                  c[6], adjusted.width,     adjusted.height};
    }
    for (size_t i = 0; i < bundle_.photo_count; ++i) {
      const double* p = pose(i);
      if (used_photos_[i]) bundle_.poses[i] = {p[0], p[1], p[2], p[3], p[4], p[5], p[6]};
    }
  }

 private:
  static ceres::Problem::Options settings() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }

  double* camera(size_t i) { return blocks_[i].data(); }
  double* pose(size_t i) { return blocks_[bundle_.camera_count + i].data(); }
  Eigen::Quaterniond rotation(size_t i) {
    const double* p = pose(i);
    return {p[3], p[0], p[1], p[2]};
  }
  Vector3 translation(size_t i) { return Eigen::Map<const Vector3>(pose(i) + 4); }
  double* point(size_t i) const { return MutableStrided<double>(bundle_.points)[i]; }

  /// Copies cameras and poses to the parameter blocks.
  void load() {
    for (size_t i = 0; i < bundle_.camera_count; ++i) {
      const ck_camera& c = bundle_.cameras[i];
      require(c.fx > 0 && c.fy > 0, "a camera has no focal length");
      blocks_.push_back({c.fx, c.cx, c.cy, c.k1, c.k2, c.p1, c.p2});
      aspects_.push_back(c.fy / c.fx);
    }
    for (size_t i = 0; i < bundle_.photo_count; ++i) {
      const Eigen::Quaterniond q = quaternion_of(bundle_.poses[i]);
      const ck_pose& p = bundle_.poses[i];
      blocks_.push_back({q.x(), q.y(), q.z(), q.w(), p.tx, p.ty, p.tz});
    }
    used_cameras_.resize(bundle_.camera_count);
    used_photos_.resize(bundle_.photo_count);
  }

  /// Adds a residual per observation; points that are adjusted are eliminated first.
  void add_observations() {
    std::vector<bool> used_points(bundle_.points.count);
    for (size_t i = 0; i < bundle_.observation_count; ++i) {
      const ck_observation& o = bundle_.observations[i];
      require(o.photo >= 0 && size_t(o.photo) < bundle_.photo_count && o.point >= 0 &&
                  size_t(o.point) < bundle_.points.count,
              "an observation refers to a photo or point that does not exist");
      const int32_t index = bundle_.photo_cameras[o.photo];
      require(index >= 0 && size_t(index) < bundle_.camera_count,
              "a photo refers to a camera that does not exist");
      used_cameras_[size_t(index)] = true;
      used_photos_[size_t(o.photo)] = true;
      used_points[size_t(o.point)] = true;
      problem_.AddResidualBlock(new ReprojectionCost(o.x, o.y, aspects_[size_t(index)]), &loss_,
                                pose(size_t(o.photo)), point(size_t(o.point)),
                                camera(size_t(index)));
    }
    ordering_ = std::make_shared<ceres::ParameterBlockOrdering>();
    for (size_t i = 0; i < bundle_.points.count; ++i) {
      if (!used_points[i]) continue;
      if (bundle_.point_freedom[i]) {
        ordering_->AddElementToGroup(point(i), 0);
      } else {
        problem_.SetParameterBlockConstant(point(i));
        ordering_->AddElementToGroup(point(i), 1);
      }
    }
  }

  /// Fixes what the freedom of cameras and poses excludes.
  void constrain() {
    for (size_t i = 0; i < bundle_.photo_count; ++i) {
      if (!used_photos_[i]) continue;
      double* block = pose(i);
      ordering_->AddElementToGroup(block, 1);
      if (bundle_.pose_freedom[i] == ck_pose_constant) {
        problem_.SetParameterBlockConstant(block);
        continue;
      }
      ++free_photos_;
      const bool keeps_scale = bundle_.pose_freedom[i] == ck_pose_scale_fixed;
      manifolds_.push_back(std::make_unique<PoseManifold>(keeps_scale ? scale_axis(i) : -1));
      problem_.SetManifold(block, manifolds_.back().get());
    }
    for (size_t i = 0; i < bundle_.camera_count; ++i) {
      if (used_cameras_[i]) constrain_camera(i);
    }
  }

  /// The component of a photo's translation that changes most when the world is scaled about the
  /// first constant photo: the derivative of the translation is that photo's center in this photo's
  /// frame.
  int scale_axis(size_t i) {
    Vector3 center = Vector3::Zero();
    for (size_t k = 0; k < bundle_.photo_count; ++k) {
      if (!used_photos_[k] || bundle_.pose_freedom[k] != ck_pose_constant) continue;
      center = -(rotation(k).conjugate() * translation(k));
      break;
    }
    int axis = 0;
    (rotation(i) * center + translation(i)).cwiseAbs().maxCoeff(&axis);
    return axis;
  }

  void constrain_camera(size_t i) {
    double* block = camera(i);
    ordering_->AddElementToGroup(block, 1);
    const uint32_t freedom = bundle_.camera_freedom[i];
    const uint32_t bits[kCameraSize] = {
        ck_free_focal_length, ck_free_principal_point, ck_free_principal_point, ck_free_k1,
        ck_free_k2,           ck_free_tangential,      ck_free_tangential};
    std::vector<int> constant;
    for (int k = 0; k < kCameraSize; ++k) {
      if (!(freedom & bits[k])) constant.push_back(k);
    }
    if (constant.size() == kCameraSize) {
      problem_.SetParameterBlockConstant(block);
      return;
    }
    if (!constant.empty()) {
      manifolds_.push_back(std::make_unique<ceres::SubsetManifold>(kCameraSize, constant));
      problem_.SetManifold(block, manifolds_.back().get());
    }
    problem_.AddResidualBlock(new CameraPriorCost(bundle_.camera_priors[i]), nullptr, block);
  }

  ck_bundle& bundle_;
  const ck_bundle_options& options_;
  ceres::HuberLoss loss_;
  std::vector<std::unique_ptr<ceres::Manifold>> manifolds_;
  /// Cameras, then poses, in one buffer: Ceres orders parameter blocks by address, and sums depend
  /// on the order.
  std::vector<std::array<double, kPoseSize>> blocks_;
  std::vector<double> aspects_;
  std::vector<bool> used_cameras_, used_photos_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
  int free_photos_ = 0;
  ceres::Problem problem_;
};

}  // namespace
}  // namespace ck

ck_status ck_bundle_adjust(ck_bundle* bundle, const ck_bundle_options* options,
                           const ck_control* control, ck_bundle_summary* summary) {
  return ck::guarded([&] {
    using namespace ck;
    require(bundle && summary && options, "bundle adjustment needs a scene");
    require(options->maximum_iterations >= 0 && options->huber_width > 0,
            "a bundle adjustment option is out of range");
    *summary = {0, 0, 0, true};
    if (bundle->observation_count == 0) return;
    step(control, 0);
    Adjustment adjustment(*bundle, *options);
    ControlCallback callback(control, options->maximum_iterations);
    const ceres::Solver::Summary result = adjustment.solve(callback);
    if (callback.canceled) throw Canceled{};
    if (result.termination_type == ceres::FAILURE) throw std::runtime_error(result.message);
    if (!adjustment.is_valid()) throw std::runtime_error("bundle adjustment diverged");
    adjustment.store();
    *summary = {2 * result.initial_cost, 2 * result.final_cost,
                static_cast<int32_t>(result.iterations.size()),
                result.termination_type == ceres::CONVERGENCE};
  });
}

ck_status ck_reprojection_jacobians(const ck_camera* camera, const ck_pose* pose,
                                    const double* point, const double* pixel, double* residual,
                                    double* pose_jacobian, double* point_jacobian,
                                    double* camera_jacobian) {
  return ck::guarded([&] {
    using namespace ck;
    require(residual && pose_jacobian && point_jacobian && camera_jacobian && camera && pose &&
                point && pixel,
            "missing argument");
    const double p[kPoseSize] = {pose->qx, pose->qy, pose->qz, pose->qw,
                                 pose->tx, pose->ty, pose->tz};
    const double c[kCameraSize] = {camera->fx, camera->cx, camera->cy, camera->k1,
                                   camera->k2, camera->p1, camera->p2};
    const double* parameters[3] = {p, point, c};
    double ambient[2 * kPoseSize];
    double* jacobians[3] = {ambient, point_jacobian, camera_jacobian};
    ReprojectionCost(pixel[0], pixel[1], camera->fy / camera->fx)
        .Evaluate(parameters, residual, jacobians);
    for (int row = 0; row < 2; ++row) {
      std::copy(ambient + row * kPoseSize, ambient + row * kPoseSize + 6, pose_jacobian + 6 * row);
    }
  });
}
