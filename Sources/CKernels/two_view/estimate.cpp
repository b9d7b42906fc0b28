#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "ck_two_view.h"
#include "core/guard.h"
#include "core/median.h"
#include "two_view/ransac.h"
#include "two_view/relative_pose.h"
#include "two_view/solvers.h"

namespace ck {
namespace {

/// Levenberg–Marquardt steps within RANSAC and at its end. Chosen.
constexpr int kLocalSteps = 8, kFinalSteps = 30;
/// Largest number of samples for the homography. Chosen: only its number of inliers is used.
constexpr int kMaximumHomographyIterations = 200;

/// Copies the points of a sample.
template <size_t N>
void gather(const Matches& matches, const std::array<size_t, N>& sample, Eigen::Vector2d* first,
            Eigen::Vector2d* second) {
  for (size_t k = 0; k < N; ++k) {
    first[k] = matches.first[sample[k]];
    second[k] = matches.second[sample[k]];
  }
}

/// The matches with a Sampson error below `limit`.
std::vector<size_t> inliers_of(const Eigen::Matrix3d& matrix, const Matches& matches,
                               double limit) {
  std::vector<double> errors(matches.size());
  sampson_errors(matrix, matches, 0, matches.size(), errors.data());
  std::vector<size_t> inliers;
  for (size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] < limit * limit) inliers.push_back(i);
  }
  return inliers;
}

/// Essential matrices for `ransac`.
struct EssentialEstimator {
  using Model = Eigen::Matrix3d;
  static constexpr size_t kSampleSize = 5;  // Limit: a minimal sample.
  const Matches& matches;

  size_t size() const { return matches.size(); }

  void solve(const std::array<size_t, kSampleSize>& sample, Matrix3List& models) const {
    Eigen::Vector2d first[kSampleSize], second[kSampleSize];
    gather(matches, sample, first, second);
    five_point(first, second, models);
  }

  void errors(const Model& model, size_t begin, size_t end, double* squared) const {
    sampson_errors(model, matches, begin, end, squared);
  }

  void refine(Model& model, double limit) const {
    RelativePose pose = decompose(model, matches, inliers_of(model, matches, limit));
    refine_pose(pose, matches, limit, kLocalSteps);
    model = pose.essential();
  }
};

/// Fundamental matrices for `ransac`.
struct FundamentalEstimator {
  using Model = Eigen::Matrix3d;
  static constexpr size_t kSampleSize = 7;  // Limit: a minimal sample.
  const Matches& matches;

  size_t size() const { return matches.size(); }

  void solve(const std::array<size_t, kSampleSize>& sample, Matrix3List& models) const {
    Eigen::Vector2d first[kSampleSize], second[kSampleSize];
    gather(matches, sample, first, second);
    seven_point(first, second, models);
  }

  void errors(const Model& model, size_t begin, size_t end, double* squared) const {
    sampson_errors(model, matches, begin, end, squared);
  }

  void refine(Model& model, double limit) const {
    refine_fundamental(model, matches, limit, kLocalSteps);
  }
};

/// Homographies for `ransac`.
struct HomographyEstimator {
  using Model = Eigen::Matrix3d;
  static constexpr size_t kSampleSize = 4;  // Limit: a minimal sample.
  const Matches& matches;

  size_t size() const { return matches.size(); }

  void solve(const std::array<size_t, kSampleSize>& sample, Matrix3List& models) const {
    std::vector<Eigen::Vector2d> first(kSampleSize), second(kSampleSize);
    gather(matches, sample, first.data(), second.data());
    Eigen::Matrix3d model;
    models.clear();
    if (homography(first, second, model)) models.push_back(model);
  }

  void errors(const Model& model, size_t begin, size_t end, double* squared) const {
    transfer_errors(model, matches, begin, end, squared);
  }

  void refine(Model& model, double limit) const {
    std::vector<double> squared(matches.size());
    errors(model, 0, matches.size(), squared.data());
    std::vector<Eigen::Vector2d> first, second;
    for (size_t i = 0; i < squared.size(); ++i) {
      if (squared[i] >= limit * limit) continue;
      first.push_back(matches.first[i]);
      second.push_back(matches.second[i]);
    }
    Eigen::Matrix3d refined;
    if (first.size() > kSampleSize && homography(first, second, refined)) model = refined;
  }
};

Matches subset(const Matches& matches, const std::vector<size_t>& indices) {
  std::vector<double> first, second;
  for (size_t i : indices) {
    first.insert(first.end(), {matches.x1[i], matches.y1[i]});
    second.insert(second.end(), {matches.x2[i], matches.y2[i]});
  }
  return Matches(first.data(), second.data(), indices.size());
}

/// The number of matches that a single homography explains.
size_t homography_support(const Matches& matches, const RansacOptions& options,
                          const ck_control* control) {
  RansacOptions quick = options;
  quick.maximum_iterations = std::min(options.maximum_iterations, kMaximumHomographyIterations);
  const auto result = ransac(HomographyEstimator{matches}, quick, control);
  return result.found ? result.inlier_count : 0;
}

/// The geometry of two views.
struct Estimate {
  Eigen::Matrix3d matrix;
  RelativePose pose;
  std::vector<size_t> inliers;
  /// Triangulation angles of the inliers in radians.
  std::vector<double> angles;
  int iterations = 0;
};

/// Triangulation angle in radians below which noise decides whether a point is in front of the
/// cameras. Chosen: a pixel at a focal length of 1000 pixels.
constexpr double kSmallAngle = 1e-3;

/// Keeps the inliers in front of both cameras and collects their triangulation angles.
void check_visibility(Estimate& estimate, const Matches& matches) {
  std::vector<size_t> visible;
  for (size_t i : estimate.inliers) {
    const Triangulation point = triangulate(estimate.pose, matches.first[i], matches.second[i]);
    if (!point.in_front && point.angle > kSmallAngle) continue;
    visible.push_back(i);
    estimate.angles.push_back(point.angle);
  }
  estimate.inliers = visible;
}

Estimate estimate_calibrated(const Matches& matches, const RansacOptions& options,
                             const ck_control* control) {
  const auto found = ransac(EssentialEstimator{matches}, options, control);
  if (!found.found) throw Degenerate("no essential matrix agrees with the matches");
  Estimate estimate;
  estimate.iterations = found.iterations;
  const double limit = options.maximum_error;
  estimate.pose = decompose(found.model, matches, inliers_of(found.model, matches, limit));
  refine_pose(estimate.pose, matches, limit, kFinalSteps);
  estimate.matrix = estimate.pose.essential();
  estimate.inliers = inliers_of(estimate.matrix, matches, limit);
  estimate.pose = decompose(estimate.matrix, matches, estimate.inliers);
  check_visibility(estimate, matches);
  return estimate;
}

Estimate estimate_uncalibrated(const Matches& matches, const RansacOptions& options,
                               const ck_control* control) {
  const auto found = ransac(FundamentalEstimator{matches}, options, control);
  if (!found.found) throw Degenerate("no fundamental matrix agrees with the matches");
  Estimate estimate;
  estimate.iterations = found.iterations;
  estimate.matrix = found.model;
  refine_fundamental(estimate.matrix, matches, options.maximum_error, kFinalSteps);
  estimate.inliers = inliers_of(estimate.matrix, matches, options.maximum_error);
  estimate.pose = decompose(estimate.matrix, matches, estimate.inliers);
  for (size_t i : estimate.inliers) {
    estimate.angles.push_back(
        triangulate(estimate.pose, matches.first[i], matches.second[i]).angle);
  }
  return estimate;
}

void write_matrix(const Eigen::Matrix3d& matrix, double* elements) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(elements, 3, 3) = matrix;
}

void write(const Estimate& estimate, size_t homography_inliers, ck_two_view_result* result) {
  write_matrix(estimate.matrix, result->matrix);
  const Eigen::Quaterniond q(estimate.pose.rotation);
  const double rotation[4] = {q.x(), q.y(), q.z(), q.w()};
  std::copy_n(rotation, 4, result->rotation);
  for (int k = 0; k < 3; ++k) result->translation[k] = estimate.pose.translation[k];
  result->inlier_count = estimate.inliers.size();
  result->homography_inlier_count = homography_inliers;
  result->median_angle = estimate.angles.empty() ? 0 : median(estimate.angles);
  result->iterations = estimate.iterations;
}

bool all_finite(const double* values, size_t count) {
  return std::all_of(values, values + count, [](double v) { return std::isfinite(v); });
}

template <void (*solver)(const Eigen::Vector2d*, const Eigen::Vector2d*, Matrix3List&), size_t N>
ck_status solve_minimal(const double* first, const double* second, double* matrices,
                        size_t* count) {
  return guarded([&] {
    require(first && second && matrices && count, "an argument is missing");
    Eigen::Vector2d a[N], b[N];
    for (size_t i = 0; i < N; ++i) {
      a[i] = {first[2 * i], first[2 * i + 1]};
      b[i] = {second[2 * i], second[2 * i + 1]};
    }
    Matrix3List models;
    solver(a, b, models);
    *count = models.size();
    for (size_t i = 0; i < models.size(); ++i) write_matrix(models[i], matrices + 9 * i);
  });
}

}  // namespace
}  // namespace ck

ck_status ck_five_point(const double* first, const double* second, double* matrices,
                        size_t* count) {
  return ck::solve_minimal<ck::five_point, 5>(first, second, matrices, count);
}

ck_status ck_seven_point(const double* first, const double* second, double* matrices,
                         size_t* count) {
  return ck::solve_minimal<ck::seven_point, 7>(first, second, matrices, count);
}

ck_status ck_two_view_estimate(const ck_point_pairs* pairs, const ck_two_view_options* options,
                               const ck_control* control, ck_two_view_result* result,
                               uint8_t* inliers) {
  return ck::guarded([&] {
    ck::require(pairs && options && result && inliers, "an argument is missing");
    const auto [first, second, count] = *pairs;
    ck::require(options->maximum_error > 0 && options->confidence > 0 && options->confidence < 1,
                "an option is out of range");
    ck::require(ck::all_finite(first, 2 * count) && ck::all_finite(second, 2 * count),
                "a point is not finite");
    std::fill_n(inliers, count, uint8_t{0});
    const ck::Matches matches(first, second, count);
    const ck::RansacOptions ransac{options->maximum_error, options->confidence,
                                   options->minimum_iterations, options->maximum_iterations,
                                   options->seed};
    const ck::Estimate estimate = options->is_calibrated
                                      ? ck::estimate_calibrated(matches, ransac, control)
                                      : ck::estimate_uncalibrated(matches, ransac, control);
    const size_t planar =
        ck::homography_support(ck::subset(matches, estimate.inliers), ransac, control);
    ck::write(estimate, planar, result);
    for (size_t i : estimate.inliers) inliers[i] = 1;
  });
}
