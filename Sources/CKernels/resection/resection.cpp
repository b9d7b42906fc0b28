#include "ck_resection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <vector>

#include "core/guard.h"
#include "core/random.h"
#include "core/span.h"
#include "resection/p3p.h"

namespace ck {
namespace {

/// Levenberg–Marquardt: initial damping, its bounds, and the relative decrease of the cost below
/// which it stops. Chosen.
constexpr double kInitialDamping = 1e-4, kMinimumDamping = 1e-12, kMaximumDamping = 1e6;
constexpr double kTolerance = 1e-8;
/// Factor by which the damping changes after a step. Paper: Marquardt 1963, ν.
constexpr double kDampingFactor = 10;
/// Largest number of steps within RANSAC and at its end. Chosen.
constexpr int kLocalSteps = 8, kFinalSteps = 20;
/// The Huber loss changes from quadratic to linear at the error limit divided by this number within
/// RANSAC, and at most at this number of pixels at its end. Chosen.
constexpr double kLocalHuberDivisor = 3, kMaximumHuberWidth = 1;
/// Smallest number of hypotheses. Chosen: a minimal sample is never exact.
constexpr int kMinimumIterations = 30;
/// Number of hypotheses between two progress reports. Chosen: far less than a second.
constexpr int kReportInterval = 50;

/// The 2D–3D correspondences of a photo.
struct Resection {
  const ck_camera& camera;
  std::vector<Vector3> points;
  std::vector<Vector2> pixels;
  /// Unit rays in the camera frame.
  std::vector<Vector3> rays;
  /// Square of the largest reprojection error of an inlier.
  double maximum_square;

  size_t size() const { return points.size(); }

  /// The squared reprojection error in pixels squared; infinite behind the camera.
  double square_error(const Pose& pose, size_t i) const {
    const Vector3 p = pose * points[i];
    if (!(p.z() > kMinimumDepth)) return std::numeric_limits<double>::infinity();
    return (project(camera, p) - pixels[i]).squaredNorm();
  }

  /// Σ min(e², limit²); stops once it exceeds `best`.
  double score(const Pose& pose, double best) const {
    double sum = 0;
    for (size_t i = 0; i < size(); ++i) {
      sum += std::min(square_error(pose, i), maximum_square);
      if (sum >= best) return sum;
    }
    return sum;
  }

  size_t count_inliers(const Pose& pose) const {
    size_t count = 0;
    for (size_t i = 0; i < size(); ++i) count += square_error(pose, i) <= maximum_square;
    return count;
  }

  /// Draws three correspondences and computes their poses; false if there are none.
  bool sample(Random& random, std::array<Pose, 4>& poses, int& found) const {
    const auto draw = [&] { return static_cast<size_t>(random.next() % size()); };
    size_t index[3];
    index[0] = draw();
    do index[1] = draw();
    while (index[1] == index[0]);
    do index[2] = draw();
    while (index[2] == index[0] || index[2] == index[1]);
    std::array<Vector3, 3> r, p;
    for (int k = 0; k < 3; ++k) {
      r[k] = rays[index[k]];
      p[k] = points[index[k]];
    }
    found = p3p(r, p, poses);
    return found > 0;
  }

  /// Normal equations over the points within the error limit, weighted by a Huber loss. Returns the
  /// truncated cost.
  double normal_equations(const Pose& pose, double huber, Eigen::Matrix<double, 6, 6>& h,
                          Eigen::Matrix<double, 6, 1>& g) const {
    h.setZero();
    g.setZero();
    double cost = 0;
    for (size_t i = 0; i < size(); ++i) {
      const Vector3 rotated = pose.rotation * points[i];
      const Vector3 p = rotated + pose.translation;
      if (!(p.z() > kMinimumDepth)) {
        cost += maximum_square;
        continue;
      }
      const Vector2 r = project(camera, p) - pixels[i];
      const double square = r.squaredNorm();
      cost += std::min(square, maximum_square);
      if (square > maximum_square) continue;
      const Eigen::Matrix<double, 2, 3> jp = project_jacobian(camera, p);
      Eigen::Matrix<double, 2, 6> j;
      for (int row = 0; row < 2; ++row) {
        j.block<1, 3>(row, 0) = rotated.cross(jp.row(row).transpose()).transpose();
      }
      j.rightCols<3>() = jp;
      const double norm = std::sqrt(square);
      const double weight = norm > huber ? huber / norm : 1;
      h.noalias() += weight * j.transpose() * j;
      g.noalias() += weight * j.transpose() * r;
    }
    return cost;
  }

  /// Levenberg–Marquardt on the inliers.
  Pose refine(Pose pose, int iterations, double huber) const {
    double lambda = kInitialDamping;
    Eigen::Matrix<double, 6, 6> h;
    Eigen::Matrix<double, 6, 1> g;
    double cost = normal_equations(pose, huber, h, g);
    for (int i = 0; i < iterations; ++i) {
      Eigen::Matrix<double, 6, 6> damped = h;
      damped.diagonal() *= 1 + lambda;
      damped.diagonal().array() += 1e-12;
      const Eigen::Matrix<double, 6, 1> step = damped.ldlt().solve(-g);
      if (!step.allFinite()) break;
      Pose next;
      next.rotation = exponential(step.head<3>()).toRotationMatrix() * pose.rotation;
      next.translation = pose.translation + step.tail<3>();
      Eigen::Matrix<double, 6, 6> next_h;
      Eigen::Matrix<double, 6, 1> next_g;
      const double next_cost = normal_equations(next, huber, next_h, next_g);
      if (next_cost < cost) {
        const bool converged = cost - next_cost < kTolerance * cost;
        pose = next;
        cost = next_cost;
        h = next_h;
        g = next_g;
        lambda = std::max(kMinimumDamping, lambda / kDampingFactor);
        if (converged) break;
      } else {
        lambda *= kDampingFactor;
        if (lambda > kMaximumDamping) break;
      }
    }
    return pose;
  }
};

/// Number of hypotheses for the required probability of an outlier-free sample.
int needed_iterations(double inlier_ratio, double confidence) {
  const double miss = 1 - inlier_ratio * inlier_ratio * inlier_ratio;
  if (miss <= 0) return 1;
  if (miss >= 1) return std::numeric_limits<int>::max();
  const double n = std::log(1 - confidence) / std::log(miss);
  return n > 1e9 ? std::numeric_limits<int>::max() : static_cast<int>(std::ceil(n));
}

/// LO-RANSAC: the pose with the lowest score; false if no sample determines one.
bool search(const Resection& problem, const ck_resection_options& options,
            const ck_control* control, Pose& best) {
  Random random(options.seed);
  double best_score = std::numeric_limits<double>::infinity();
  const int least = std::min(options.maximum_iterations, kMinimumIterations);
  int limit = options.maximum_iterations;
  std::array<Pose, 4> poses;
  for (int iteration = 0; iteration < std::max(least, limit); ++iteration) {
    if (iteration % kReportInterval == 0)
      step(control, double(iteration) / options.maximum_iterations);
    int found = 0;
    if (!problem.sample(random, poses, found)) continue;
    for (int k = 0; k < found; ++k) {
      double score = problem.score(poses[k], best_score);
      if (!(score < best_score)) continue;
      best = poses[k];
      best_score = score;
      const Pose local = problem.refine(poses[k], kLocalSteps,
                                        std::sqrt(problem.maximum_square) / kLocalHuberDivisor);
      score = problem.score(local, best_score);
      if (score < best_score) {
        best = local;
        best_score = score;
      }
      const double ratio = double(problem.count_inliers(best)) / double(problem.size());
      limit = std::min(options.maximum_iterations, needed_iterations(ratio, options.confidence));
    }
  }
  return std::isfinite(best_score);
}

}  // namespace
}  // namespace ck

ck_status ck_resect(const ck_camera* camera, ck_span pixels, ck_span points,
                    const ck_resection_options* options, const ck_control* control, ck_pose* pose,
                    uint8_t* inliers, size_t* inlier_count) {
  return ck::guarded([&] {
    using namespace ck;
    require(pose && inliers && inlier_count && points.count == pixels.count && camera && options,
            "resection needs pixels, points and a camera");
    require(options->maximum_error > 0 && options->maximum_iterations > 0,
            "a resection option is out of range");
    *inlier_count = 0;
    const size_t count = points.count;
    if (count < 4) throw Degenerate("resection needs at least four points");
    Resection problem{*camera, {}, {}, {}, options->maximum_error * options->maximum_error};
    for (size_t i = 0; i < count; ++i) {
      const double *p = Strided<double>(points)[i], *pixel = Strided<double>(pixels)[i];
      problem.points.emplace_back(p[0], p[1], p[2]);
      problem.pixels.emplace_back(pixel[0], pixel[1]);
      const Vector2 ray = unproject(*camera, pixel[0], pixel[1]);
      problem.rays.push_back(Vector3(ray.x(), ray.y(), 1).normalized());
      require(problem.points.back().allFinite() && problem.rays.back().allFinite(),
              "resection needs finite points and pixels");
    }
    Pose best;
    if (!search(problem, *options, control, best))
      throw Degenerate("no pose agrees with the points");
    best = problem.refine(best, kFinalSteps, std::min(kMaximumHuberWidth, options->maximum_error));
    for (size_t i = 0; i < count; ++i) {
      inliers[i] = problem.square_error(best, i) <= problem.maximum_square;
      *inlier_count += inliers[i];
    }
    *pose = pose_to(best);
    if (*inlier_count < static_cast<size_t>(std::max(4, options->minimum_inliers))) {
      throw Degenerate("too few points agree with one pose");
    }
  });
}
