#include <Eigen/Dense>
#include <numeric>

#include "ck_two_view.h"
#include "core/guard.h"
#include "two_view/relative_pose.h"

namespace ck {
namespace {

/// Levenberg–Marquardt steps per factor. Chosen.
constexpr int kSteps = 15;

/// The points for `factor` times the focal length.
Matches scaled(const ck_point_pairs& pairs, double factor) {
  const auto [first, second, count] = pairs;
  std::vector<double> a(first, first + 2 * count), b(second, second + 2 * count);
  for (double& v : a) v /= factor;
  for (double& v : b) v /= factor;
  return Matches(a.data(), b.data(), count);
}

double cost(const ck_point_pairs& pairs, const Eigen::Matrix3d& fundamental, double limit,
            double factor) {
  const Matches matches = scaled(pairs, factor);
  const Eigen::DiagonalMatrix<double, 3> d(factor, factor, 1);
  const Eigen::Matrix3d essential = d * fundamental * d;
  std::vector<size_t> all(pairs.count);
  std::iota(all.begin(), all.end(), size_t{0});
  RelativePose pose = decompose(essential, matches, all);
  return factor * factor * refine_pose(pose, matches, limit / factor, kSteps);
}

}  // namespace
}  // namespace ck

ck_status ck_focal_length_costs(const ck_point_pairs* pairs, const double* factors,
                                size_t factor_count, const ck_focal_length_options* options,
                                const ck_control* control, double* costs) {
  return ck::guarded([&] {
    const Eigen::Matrix3d f =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(options->fundamental);
    ck::require(f.allFinite() && options->maximum_error > 0,
                "the matrix or the limit is out of range");
    for (size_t i = 0; i < factor_count; ++i) {
      ck::require(factors[i] > 0, "a factor is not positive");
      ck::step(control, static_cast<double>(i) / static_cast<double>(factor_count));
      costs[i] = ck::cost(*pairs, f, options->maximum_error, factors[i]);
    }
  });
}
