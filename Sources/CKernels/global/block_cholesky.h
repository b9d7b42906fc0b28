#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/eigen_sparse.h"

namespace ck {

/// A sparse symmetric positive definite matrix of 3×3 blocks, and its factorization.
///
/// The lower triangle is stored column by column; the sparsity pattern is fixed.
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
  void add(size_t slot, const Eigen::Matrix3d& block);

  /// Factorizes the matrix; false if it is not positive definite.
  bool factorize();

  /// Solves for a right-hand side with the last factorization.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  /// Start of the three columns of a block in the values.
  struct Place {
    int starts[3];
    bool is_diagonal;
  };

  /// Rows of the blocks of each column, ascending.
  std::vector<std::vector<int32_t>> rows_;
  std::vector<size_t> first_slot_;
  std::vector<Place> places_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace ck
