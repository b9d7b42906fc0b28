#pragma once

#include <optional>

#include "bundle/reduced_system.h"
#include "sparse/multifrontal_cholesky.h"

namespace ck {

/// Solves reduced camera systems with the same blocks: as dense matrices up to a number of poses,
/// as sparse ones up to an amount of work, and by conjugate gradients above it.
class ReducedSolver {
 public:
  ReducedSolver(const ReducedSystem& system, const ck_bundle_options& options,
                const ck_control* control)
      : system_(system), options_(options), control_(control) {}

  /// The solution; empty if the matrix is not positive definite.
  Eigen::VectorXd solve();

 private:
  Eigen::VectorXd solve_dense() const;
  Eigen::VectorXd solve_sparse();
  Eigen::VectorXd solve_iteratively() const;
  /// The matrix times a vector.
  Eigen::VectorXd multiply(const Eigen::VectorXd& x) const;

  const ReducedSystem& system_;
  const ck_bundle_options& options_;
  const ck_control* control_;
  std::optional<MultifrontalCholesky> sparse_;
};

}  // namespace ck
