#pragma once

#include <Eigen/SparseCholesky>
#include <cstdint>
#include <utility>
#include <vector>

namespace ck {

/// A symmetric positive definite matrix of 3×3 blocks, of which many are zero, and its factor.
///
/// The lower triangle is stored column by column; which blocks there are never changes.
class BlockCholesky {
 public:
  /// `blocks` are the places (row ≥ column) of the blocks, in any order, doubles allowed; every
  /// block of the diagonal is there anyway.
  BlockCholesky(size_t size, std::vector<std::pair<int32_t, int32_t>> blocks);

  /// The number of a block for `add`.
  size_t slot(int32_t row, int32_t column) const;

  void clear();

  /// Adds to a block; of those of the diagonal the lower triangle counts.
  void add(size_t slot, const Eigen::Matrix3d& block);

  /// False where the matrix isn't positive definite.
  bool factorise();

  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  /// Where the three columns of a block begin in the values.
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
