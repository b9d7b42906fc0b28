#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "two_view/relative_pose.h"

namespace ck {
namespace {

/// Levenberg–Marquardt: the initial damping and the factors by which it changes after a step.
/// Paper: Hartley and Zisserman 2004, appendix 6.2.
constexpr double kInitialDamping = 1e-3, kDampingIncrease = 10, kDampingDecrease = 0.1;
/// Bounds of the damping, and the relative decrease of the cost at which it stops. Chosen.
constexpr double kMinimumDamping = 1e-9, kMaximumDamping = 1e6;
constexpr double kTolerance = 1e-9;

/// A matrix with its derivatives with respect to the local parameters.
template <int N>
struct Linearized {
  Eigen::Matrix3d matrix;
  Eigen::Matrix<double, 9, N> derivatives;

  void set_derivative(int k, const Eigen::Matrix3d& d) {
    derivatives.col(k) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(d.data());
  }
};

/// Two unit vectors orthogonal to `v` and to each other.
Eigen::Matrix<double, 3, 2> tangent(const Eigen::Vector3d& v) {
  int axis;
  v.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = v.cross(Eigen::Vector3d::Unit(axis)).normalized();
  basis.col(1) = v.cross(basis.col(0)).normalized();
  return basis;
}

/// The five parameters of a relative pose: a rotation vector applied from the left, and the
/// direction of the translation.
struct PoseParameters {
  static constexpr int kCount = 5;  // Limit: the degrees of freedom.
  RelativePose pose;

  Linearized<kCount> linearized() const {
    Linearized<kCount> result;
    const Eigen::Matrix3d t = cross_matrix(pose.translation);
    result.matrix = t * pose.rotation;
    for (int k = 0; k < 3; ++k) {
      result.set_derivative(k, t * cross_matrix(Eigen::Vector3d::Unit(k)) * pose.rotation);
    }
    const auto basis = tangent(pose.translation);
    for (int k = 0; k < 2; ++k) {
      result.set_derivative(3 + k, cross_matrix(basis.col(k)) * pose.rotation);
    }
    return result;
  }

  PoseParameters moved(const Eigen::Matrix<double, kCount, 1>& step) const {
    PoseParameters result;
    result.pose.rotation = rotation_exponential(step.head<3>()) * pose.rotation;
    result.pose.translation =
        (pose.translation + tangent(pose.translation) * step.tail<2>()).normalized();
    return result;
  }
};

/// The seven parameters of a fundamental matrix U diag(1, s, 0) Vᵀ: rotation vectors of U and V,
/// and s.
struct FundamentalParameters {
  static constexpr int kCount = 7;  // Limit: the degrees of freedom.
  Eigen::Matrix3d u, v;
  double s;

  Eigen::Matrix3d matrix() const {
    return u.col(0) * v.col(0).transpose() + s * u.col(1) * v.col(1).transpose();
  }

  Linearized<kCount> linearized() const {
    Linearized<kCount> result;
    result.matrix = matrix();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Matrix3d axis = cross_matrix(Eigen::Vector3d::Unit(k));
      result.set_derivative(k, axis * result.matrix);
      result.set_derivative(3 + k, -result.matrix * axis);
    }
    result.set_derivative(6, u.col(1) * v.col(1).transpose());
    return result;
  }

  FundamentalParameters moved(const Eigen::Matrix<double, kCount, 1>& step) const {
    return {rotation_exponential(step.head<3>()) * u, rotation_exponential(step.segment<3>(3)) * v,
            s + step[6]};
  }
};

/// The sum of the squared Sampson errors, each truncated at `limit`².
double truncated_cost(const Eigen::Matrix3d& matrix, const Matches& matches, double limit) {
  std::vector<double> errors(matches.size());
  sampson_errors(matrix, matches, 0, matches.size(), errors.data());
  double sum = 0;
  for (double e : errors) sum += e < limit * limit ? e : limit * limit;
  return sum;
}

/// Normal equations of the Sampson errors below `limit`.
template <int N>
void accumulate(const Linearized<N>& model, const Matches& matches, double limit,
                Eigen::Matrix<double, N, N>& normal, Eigen::Matrix<double, N, 1>& gradient) {
  normal.setZero();
  gradient.setZero();
  const Eigen::Matrix3d& m = model.matrix;
  for (size_t i = 0; i < matches.size(); ++i) {
    const Eigen::Vector3d p = matches.first[i].homogeneous(), q = matches.second[i].homogeneous();
    const Eigen::Vector3d mp = m * p, mq = m.transpose() * q;
    const double c = q.dot(mp);
    const double squared = mp.head<2>().squaredNorm() + mq.head<2>().squaredNorm();
    if (!(c * c < limit * limit * squared)) continue;
    const double inverse = 1 / std::sqrt(squared), residual = c * inverse;
    const double factor = residual * inverse * inverse;
    // The derivative of the residual with respect to the nine elements of the matrix.
    Eigen::Matrix3d slope = inverse * q * p.transpose();
    slope.row(0) -= factor * mp[0] * p.transpose();
    slope.row(1) -= factor * mp[1] * p.transpose();
    slope.col(0) -= factor * mq[0] * q;
    slope.col(1) -= factor * mq[1] * q;
    const Eigen::Matrix<double, N, 1> j =
        model.derivatives.transpose() * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(slope.data());
    normal.template selfadjointView<Eigen::Lower>().rankUpdate(j);
    gradient += residual * j;
  }
  const Eigen::Matrix<double, N, N> full = normal.template selfadjointView<Eigen::Lower>();
  normal = full;
}

/// Levenberg–Marquardt on the truncated cost; returns the cost.
template <class Parameters>
double refine(Parameters& parameters, const Matches& matches, double limit, int iterations) {
  constexpr int N = Parameters::kCount;
  double damping = kInitialDamping;
  Linearized<N> model = parameters.linearized();
  double cost = truncated_cost(model.matrix, matches, limit);
  Eigen::Matrix<double, N, N> normal;
  Eigen::Matrix<double, N, 1> gradient;
  accumulate(model, matches, limit, normal, gradient);
  for (int i = 0; i < iterations; ++i) {
    Eigen::Matrix<double, N, N> damped = normal;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-12;
    const Eigen::Matrix<double, N, 1> step = -damped.ldlt().solve(gradient);
    if (!step.allFinite()) break;
    const Parameters moved = parameters.moved(step);
    const Linearized<N> moved_model = moved.linearized();
    const double moved_cost = truncated_cost(moved_model.matrix, matches, limit);
    if (!(moved_cost < cost)) {
      damping *= kDampingIncrease;
      if (damping > kMaximumDamping) break;
      continue;
    }
    const bool converged = cost - moved_cost < kTolerance * cost;
    parameters = moved;
    model = moved_model;
    cost = moved_cost;
    damping = std::max(kMinimumDamping, damping * kDampingDecrease);
    if (converged) break;
    accumulate(model, matches, limit, normal, gradient);
  }
  return cost;
}

}  // namespace

double refine_pose(RelativePose& pose, const Matches& matches, double limit, int iterations) {
  PoseParameters parameters{pose};
  const double cost = refine(parameters, matches, limit, iterations);
  pose = parameters.pose;
  return cost;
}

double refine_fundamental(Eigen::Matrix3d& fundamental, const Matches& matches, double limit,
                          int iterations) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(fundamental,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d values = svd.singularValues();
  if (!(values[0] > 0)) return truncated_cost(fundamental, matches, limit);
  FundamentalParameters parameters{svd.matrixU(), svd.matrixV(), values[1] / values[0]};
  const double cost = refine(parameters, matches, limit, iterations);
  fundamental = parameters.matrix().normalized();
  return cost;
}

}  // namespace ck
