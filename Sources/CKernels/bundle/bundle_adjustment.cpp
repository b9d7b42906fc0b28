#include <algorithm>
#include <cmath>
#include <vector>

#include "bundle/layout.h"
#include "bundle/normal_equations.h"
#include "bundle/reduced_solver.h"
#include "ck_bundle.h"
#include "core/guard.h"
#include "core/span.h"

namespace ck {
namespace {

/// The minimizer stops at a gradient with a smaller maximum norm, or a smaller relative change of
/// the parameters. Chosen: the first is Ceres' default; its default of the second, 1e-8, stops
/// earlier.
constexpr double kGradientTolerance = 1e-10, kParameterTolerance = 1e-10;
/// Levenberg–Marquardt: the initial damping and its bounds. Chosen: Ceres' defaults. Its update is
/// that of Nielsen ("Damping parameter in Marquardt's method", 1999).
constexpr double kInitialDamping = 1e-4, kMinimumDamping = 1e-16, kMaximumDamping = 1e32;
/// The smallest share of the predicted decrease at which a step is taken. Chosen: Ceres' default.
constexpr double kMinimumGain = 1e-3;

class Adjustment {
 public:
  Adjustment(const ck_bundle& bundle, const ck_bundle_options& options, const ck_control* control)
      : layout_(bundle),
        options_(options),
        control_(control),
        equations_(bundle, layout_, options.huber_width, control),
        system_(layout_, control),
        solver_(system_, options, control) {
    for (size_t i = 0; i < bundle.camera_count; ++i) {
      parameters_.cameras.push_back(bundle.cameras[i]);
      aspects_.push_back(bundle.cameras[i].fy / bundle.cameras[i].fx);
    }
    for (size_t i = 0; i < bundle.photo_count; ++i) {
      const ck_pose& p = bundle.poses[i];
      parameters_.rotations.push_back(quaternion_of(p));
      parameters_.translations.emplace_back(p.tx, p.ty, p.tz);
    }
    const MutableStrided<double> points(bundle.points);
    for (size_t i = 0; i < points.count; ++i) parameters_.points.emplace_back(points[i]);
  }

  ck_bundle_summary minimize() {
    double cost = equations_.cost(parameters_);
    if (!std::isfinite(cost)) throw std::runtime_error("a reprojection error is not finite");
    ck_bundle_summary summary = {2 * cost, 2 * cost, 0, false};
    double damping = kInitialDamping, growth = 2;
    bool is_linearized = false;
    while (!summary.converged && summary.iterations < options_.maximum_iterations &&
           damping < kMaximumDamping) {
      step(control_, double(summary.iterations++) / options_.maximum_iterations);
      if (!is_linearized) equations_.linearize(parameters_);
      is_linearized = true;
      BundleParameters next;
      double next_cost = cost, predicted = 0;
      if (advance(damping, next, predicted, summary.converged)) next_cost = equations_.cost(next);
      if (summary.converged) break;
      if (!(predicted > 0) || !(cost - next_cost > kMinimumGain * predicted)) {
        // Near the minimum, rounding decides whether a step gains anything.
        summary.converged = predicted > 0 && predicted <= options_.function_tolerance * cost &&
                            std::abs(cost - next_cost) <= options_.function_tolerance * cost;
        damping *= growth;
        growth *= 2;
        continue;
      }
      const double gain = (cost - next_cost) / predicted;
      damping =
          std::max(kMinimumDamping, damping * std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3)));
      growth = 2;
      summary.converged = cost - next_cost <= options_.function_tolerance * cost;
      parameters_ = std::move(next);
      is_linearized = false;
      cost = next_cost;
    }
    summary.final_cost = 2 * cost;
    return summary;
  }

  /// Writes the adjusted values back; throws if a camera diverged.
  void store(ck_bundle& bundle) const {
    for (const ck_camera& c : parameters_.cameras) {
      if (!std::isfinite(c.fx + c.cx + c.cy + c.k1 + c.k2 + c.p1 + c.p2) || !(c.fx > 0)) {
        throw std::runtime_error("bundle adjustment diverged");
      }
    }
    for (const size_t i : layout_.cameras) bundle.cameras[i] = parameters_.cameras[i];
    for (const size_t i : layout_.photos) {
      bundle.poses[i] = pose_to(parameters_.rotations[i], parameters_.translations[i]);
    }
    const MutableStrided<double> points(bundle.points);
    for (size_t i = 0; i < points.count; ++i) {
      if (!layout_.is_point_free[i]) continue;
      std::copy(parameters_.points[i].data(), parameters_.points[i].data() + 3, points[i]);
    }
  }

 private:
  /// One step of the minimizer. False if the system has no solution; `predicted` is the expected
  /// decrease of the cost, and `converged` whether the parameters hardly change.
  bool advance(double damping, BundleParameters& next, double& predicted, bool& converged) {
    equations_.reduce(damping, system_);
    converged = equations_.gradient_norm() < kGradientTolerance;
    if (converged) return false;
    const Eigen::VectorXd cameras = solver_.solve();
    if (cameras.size() != system_.size()) return false;
    const BundleStep step = equations_.complete(system_, cameras);
    predicted = equations_.predicted_decrease(system_, step);
    next = parameters_;
    move(step, next);
    converged = is_small(step);
    return true;
  }

  void move(const BundleStep& step, BundleParameters& moved) const {
    for (size_t i = 0; i < layout_.photos.size(); ++i) {
      const size_t photo = layout_.photos[i];
      const auto change = step.cameras.segment<kPoseSize>(system_.pose_offset(i));
      moved.rotations[photo] =
          (exponential(change.head<3>()) * moved.rotations[photo]).normalized();
      moved.translations[photo] += change.tail<3>();
    }
    for (size_t i = 0; i < layout_.cameras.size(); ++i) {
      ck_camera& c = moved.cameras[layout_.cameras[i]];
      const auto change = step.cameras.segment<kCameraSize>(system_.camera_offset(i));
      double* values[kCameraSize] = {&c.fx, &c.cx, &c.cy, &c.k1, &c.k2, &c.p1, &c.p2};
      for (int k = 0; k < kCameraSize; ++k) *values[k] += change[k];
      c.fy = aspects_[layout_.cameras[i]] * c.fx;
    }
    for (size_t i = 0; i < moved.points.size(); ++i) moved.points[i] += step.points[i];
  }

  bool is_small(const BundleStep& step) const {
    double change = step.cameras.squaredNorm(), size = double(layout_.photos.size());
    for (const Vector3& p : step.points) change += p.squaredNorm();
    for (const Vector3& t : parameters_.translations) size += t.squaredNorm();
    for (const Vector3& p : parameters_.points) size += p.squaredNorm();
    for (const size_t i : layout_.cameras) {
      size += parameters_.cameras[i].fx * parameters_.cameras[i].fx;
    }
    return std::sqrt(change) <= kParameterTolerance * (std::sqrt(size) + kParameterTolerance);
  }

  const BundleLayout layout_;
  const ck_bundle_options& options_;
  const ck_control* control_;
  NormalEquations equations_;
  ReducedSystem system_;
  ReducedSolver solver_;
  BundleParameters parameters_;
  std::vector<double> aspects_;
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
    Adjustment adjustment(*bundle, *options, control);
    *summary = adjustment.minimize();
    adjustment.store(*bundle);
  });
}
