#include <algorithm>
#include <cmath>
#include <vector>

#include "ck_global.h"
#include "core/eigen_sparse.h"
#include "core/guard.h"
#include "core/median.h"
#include "core/span.h"
#include "geometry/camera_model.h"

namespace ck {
namespace {

/// The shortest rotation vector of a quaternion (logarithmic map), in radians.
Vector3 logarithm(Eigen::Quaterniond q) {
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  return sine > 1e-12 ? Vector3(q.vec() * (2 * std::atan2(sine, q.w()) / sine)) : 2 * q.vec();
}

/// Rotations and the graph of pairs. An update ω_i of a rotation acts from the right, in the world
/// frame, so that to first order ω_second − ω_first is the pair's error: one graph Laplacian for
/// all axes.
class RotationGraph {
 public:
  RotationGraph(const Strided<double>& rotations, const ck_relative_rotation* pairs,
                size_t pair_count)
      : pairs_(pairs), pair_count_(pair_count) {
    const size_t photo_count = rotations.count;
    for (size_t i = 0; i < photo_count; ++i) {
      const double* q = rotations[i];
      rotations_.push_back(Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized());
    }
    for (size_t k = 0; k < pair_count; ++k) {
      const ck_relative_rotation& p = pairs[k];
      require(p.first >= 0 && p.second >= 0 && p.first != p.second && p.weight > 0 &&
                  size_t(p.first) < photo_count && size_t(p.second) < photo_count,
              "a pair refers to a photo that does not exist");
      relative_.push_back(Eigen::Quaterniond(p.qw, p.qx, p.qy, p.qz).normalized());
    }
    errors_.resize(pair_count);
    weights_.resize(pair_count);
    measure();
    solver_.analyzePattern(laplacian());
  }

  /// Computes the residual rotation vector of every pair.
  void measure() {
    for (size_t k = 0; k < pair_count_; ++k) {
      errors_[k] = logarithm(rotations_[size_t(pairs_[k].second)].conjugate() * relative_[k] *
                             rotations_[size_t(pairs_[k].first)]);
    }
  }

  /// Weights each pair by `weight(error in radians)` and solves the weighted least squares problem.
  /// Returns the mean update in radians.
  template <typename Weight>
  double move(Weight&& weight) {
    for (size_t k = 0; k < pair_count_; ++k) {
      weights_[k] = pairs_[k].weight * weight(errors_[k].norm());
    }
    const Eigen::Index size = Eigen::Index(rotations_.size()) - 1;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(size, 3);
    for (size_t k = 0; k < pair_count_; ++k) {
      const Eigen::Index i = pairs_[k].first - 1, j = pairs_[k].second - 1;
      if (i >= 0) right.row(i) -= weights_[k] * errors_[k].transpose();
      if (j >= 0) right.row(j) += weights_[k] * errors_[k].transpose();
    }
    solver_.factorize(laplacian());
    if (solver_.info() != Eigen::Success) throw Degenerate("the pairs don't connect all photos");
    const Eigen::MatrixXd change = solver_.solve(right);
    if (!change.allFinite()) throw Degenerate("the pairs don't connect all photos");
    double sum = 0;
    for (Eigen::Index i = 0; i < size; ++i) {
      Eigen::Quaterniond& q = rotations_[size_t(i) + 1];
      q = (q * exponential(change.row(i).transpose())).normalized();
      sum += change.row(i).norm();
    }
    measure();
    return sum / double(std::max<Eigen::Index>(1, size));
  }

  /// The median residual in radians.
  double median_error() const { return median(angles()); }

  /// The residual of every pair in radians.
  std::vector<double> angles() const {
    std::vector<double> angles;
    for (const Vector3& error : errors_) angles.push_back(error.norm());
    return angles;
  }

  const std::vector<Eigen::Quaterniond>& rotations() const { return rotations_; }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  /// The weighted Laplacian without photo 0, which is constant.
  Matrix laplacian() const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(4 * pair_count_);
    for (size_t k = 0; k < pair_count_; ++k) {
      const int i = pairs_[k].first - 1, j = pairs_[k].second - 1;
      if (i >= 0) entries.emplace_back(i, i, weights_[k]);
      if (j >= 0) entries.emplace_back(j, j, weights_[k]);
      if (i >= 0 && j >= 0) entries.emplace_back(std::max(i, j), std::min(i, j), -weights_[k]);
    }
    Matrix matrix(Eigen::Index(rotations_.size()) - 1, Eigen::Index(rotations_.size()) - 1);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  const ck_relative_rotation* pairs_;
  size_t pair_count_;
  std::vector<Eigen::Quaterniond> rotations_, relative_;
  std::vector<Vector3> errors_;
  std::vector<double> weights_;
  Eigen::SimplicialLDLT<Matrix> solver_;
};

/// Lower bound of the residual in the weights of L1 averaging, so that they are finite: in radians,
/// and as a fraction of the median residual. Chosen.
constexpr double kMinimumResidual = 1e-6, kMinimumShareOfMedian = 0.1;
/// Scale of the robust loss, as a multiple of the median residual. Chosen.
constexpr double kScaleFactor = 3;

/// L1 averaging by iteratively reweighted least squares, then the robust loss of Geman and McClure.
void average(RotationGraph& graph, const ck_rotation_averaging_options& options,
             const ck_control* control) {
  const int total = options.absolute_iterations + options.robust_iterations;
  for (int iteration = 0; iteration < options.absolute_iterations; ++iteration) {
    step(control, double(iteration) / total);
    const double floor = std::max(kMinimumResidual, kMinimumShareOfMedian * graph.median_error());
    if (graph.move([&](double e) { return 1 / std::max(e, floor); }) < options.tolerance) break;
  }
  for (int iteration = 0; iteration < options.robust_iterations; ++iteration) {
    step(control, double(options.absolute_iterations + iteration) / total);
    const double scale = std::clamp(kScaleFactor * graph.median_error(), options.minimum_scale,
                                    options.maximum_scale);
    const double change = graph.move([&](double e) {
      const double s = 1 + e * e / (scale * scale);
      return 1 / (s * s);
    });
    if (change < options.tolerance) break;
  }
}

}  // namespace
}  // namespace ck

ck_status ck_average_rotations(const ck_relative_rotation* pairs, size_t pair_count,
                               const ck_rotation_averaging_options* options,
                               const ck_control* control, ck_mutable_span rotations,
                               double* errors) {
  return ck::guarded([&] {
    using namespace ck;
    require(rotations.data && errors && pairs && options, "rotation averaging needs pairs");
    require(rotations.count > 1 && pair_count > 0, "rotation averaging needs pairs");
    RotationGraph graph(rotations, pairs, pair_count);
    average(graph, *options, control);
    for (size_t i = 0; i < rotations.count; ++i) {
      const Eigen::Quaterniond& q = graph.rotations()[i];
      const double values[4] = {q.x(), q.y(), q.z(), q.w()};
      std::copy(values, values + 4, MutableStrided<double>(rotations)[i]);
    }
    const std::vector<double> angles = graph.angles();
    std::copy(angles.begin(), angles.end(), errors);
  });
}
