#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sparse/multifrontal_cholesky.h"

namespace ck {

/// A sparse symmetric positive definite matrix of 3×3 blocks, and its factorization.
///
/// The lower triangle is stored column by column; the sparsity pattern is fixed. Small matrices are
/// factorized one column after the other, others by fronts.
class BlockCholesky {
 public:
  /// `blocks` are the positions (row ≥ column) of the nonzero blocks, in any order, with duplicates
  /// permitted; diagonal blocks are always included.
  BlockCholesky(size_t size, std::vector<std::pair<int32_t, int32_t>> blocks);

  /// The index of a block for `add`.
  size_t slot(int32_t row, int32_t column) const;

  /// Sets all values to 0.
  void clear();

  /// Adds to a block; of a diagonal block only the lower triangle is used.
  void add(size_t slot, const Eigen::Matrix3d& block) { blocks_[slot] += block; }

  /// Factorizes the matrix; false if it is not positive definite.
  bool factorize(const ck_control* control);

  /// Solves for a right-hand side with the last factorization.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  bool factorize_columns();

  /// Rows of the blocks of each column, ascending.
  std::vector<std::vector<int32_t>> rows_;
  std::vector<size_t> first_slot_;
  std::vector<Eigen::Matrix3d> blocks_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> small_;
  /// Nothing if the matrix is small.
  std::optional<MultifrontalCholesky> large_;
};

}  // namespace ck
