#include "bundle/reduced_solver.h"

#include <Eigen/Cholesky>

namespace ck {
namespace {

/// Conjugate gradients stop when an iteration adds less than this share to the decrease of the
/// quadratic form per iteration so far. Paper: Nash and Sofer 1990, "Assessing a search direction
/// within a truncated-Newton method". The share is Ceres' default.
constexpr double kForcingSequence = 0.1;
/// Conjugate gradients stop at this number of iterations. Chosen: Ceres' default is 500.
constexpr int kMaximumConjugateSteps = 100;

BlockPattern pattern_of(const ReducedSystem& system) {
  BlockPattern pattern;
  pattern.sizes.assign(system.poses.size(), kPoseSize);
  pattern.sizes.insert(pattern.sizes.end(), system.cameras.size(), kCameraSize);
  system.for_each_block([&](size_t row, size_t column, const auto&) {
    pattern.blocks.push_back({row, column});
  });
  return pattern;
}

}  // namespace

Eigen::VectorXd ReducedSolver::solve() {
  if (system_.size() == 0) return system_.right;
  const bool is_small = int32_t(system_.poses.size()) <= options_.dense_photo_limit;
  if (!is_small && !sparse_) sparse_.emplace(pattern_of(system_));
  Eigen::VectorXd found = is_small                                  ? solve_dense()
                          : sparse_->work() <= options_.direct_work ? solve_sparse()
                                                                    : solve_iteratively();
  return found.allFinite() ? found : Eigen::VectorXd();
}

Eigen::VectorXd ReducedSolver::solve_dense() const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(system_.size(), system_.size());
  system_.for_each_block([&](size_t row, size_t column, const auto& block) {
    matrix.block(system_.offset(column), system_.offset(row), block.cols(), block.rows()) =
        block.transpose();
  });
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factorization(matrix);
  if (factorization.info() != Eigen::Success) return {};
  return factorization.solve(system_.right);
}

Eigen::VectorXd ReducedSolver::solve_sparse() {
  std::vector<const double*> values;
  system_.for_each_block(
      [&](size_t, size_t, const auto& block) { values.push_back(block.data()); });
  return sparse_->factorize(values, control_) ? sparse_->solve(system_.right) : Eigen::VectorXd();
}

Eigen::VectorXd ReducedSolver::multiply(const Eigen::VectorXd& x) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(system_.size());
  system_.for_each_block([&](size_t row, size_t column, const auto& block) {
    const Eigen::Index i = system_.offset(row), k = system_.offset(column);
    product.segment(i, block.rows()) += block * x.segment(k, block.cols());
    if (row == column) return;
    product.segment(k, block.cols()) += block.transpose() * x.segment(i, block.rows());
  });
  return product;
}

/// Conjugate gradients with the diagonal blocks as preconditioner.
Eigen::VectorXd ReducedSolver::solve_iteratively() const {
  std::vector<Eigen::LLT<Eigen::MatrixXd>> diagonal;
  for (const auto& row : system_.poses) diagonal.emplace_back(row.blocks.front());
  for (const auto& row : system_.cameras) diagonal.emplace_back(row.blocks.front());
  for (const auto& block : diagonal) {
    if (block.info() != Eigen::Success) return {};
  }
  const auto precondition = [&](const Eigen::VectorXd& r) {
    Eigen::VectorXd z(r.size());
    Eigen::Index offset = 0;
    for (const auto& block : diagonal) {
      z.segment(offset, block.cols()) = block.solve(r.segment(offset, block.cols()));
      offset += block.cols();
    }
    return z;
  };

  Eigen::VectorXd x = Eigen::VectorXd::Zero(system_.size()), r = system_.right;
  Eigen::VectorXd z = precondition(r), p = z;
  double rho = r.dot(z), decrease = 0;
  for (int i = 1; i <= kMaximumConjugateSteps && rho > 0; ++i) {
    const Eigen::VectorXd q = multiply(p);
    const double curvature = p.dot(q);
    if (!(curvature > 0)) return {};
    const double alpha = rho / curvature;
    x += alpha * p;
    r -= alpha * q;
    const double gain = alpha * rho / 2;
    decrease += gain;
    if (i * gain < kForcingSequence * decrease) break;
    z = precondition(r);
    const double next = r.dot(z);
    p = z + next / rho * p;
    rho = next;
  }
  return x;
}

}  // namespace ck
