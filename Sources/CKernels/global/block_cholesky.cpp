#include "global/block_cholesky.h"

#include <algorithm>

namespace ck {
namespace {

/// Columns of blocks up to which a matrix is small. Chosen: either factorization takes milliseconds
/// then. They round differently; up to so many photos results are those of earlier versions.
constexpr size_t kMaximumSmallSize = 100;

}  // namespace

BlockCholesky::BlockCholesky(size_t size, std::vector<std::pair<int32_t, int32_t>> blocks)
    : rows_(size) {
  for (size_t i = 0; i < size; ++i) rows_[i].push_back(int32_t(i));
  for (const auto& [row, column] : blocks) rows_[size_t(column)].push_back(row);
  BlockPattern pattern;
  pattern.sizes.assign(size, 3);
  for (size_t column = 0; column < size; ++column) {
    auto& rows = rows_[column];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    first_slot_.push_back(pattern.blocks.size());
    for (const int32_t row : rows) pattern.blocks.push_back({size_t(row), column});
  }
  blocks_.resize(pattern.blocks.size());
  if (size > kMaximumSmallSize) large_.emplace(std::move(pattern));
}

size_t BlockCholesky::slot(int32_t row, int32_t column) const {
  const auto& rows = rows_[size_t(column)];
  return first_slot_[size_t(column)] +
         size_t(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
}

void BlockCholesky::clear() { std::fill(blocks_.begin(), blocks_.end(), Eigen::Matrix3d::Zero()); }

bool BlockCholesky::factorize(const ck_control* control) {
  if (!large_) return factorize_columns();
  std::vector<const double*> values;
  for (const auto& block : blocks_) values.push_back(block.data());
  return large_->factorize(values, control);
}

bool BlockCholesky::factorize_columns() {
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t column = 0, slot = 0; column < rows_.size(); ++column) {
    for (const int32_t row : rows_[column]) {
      const Eigen::Matrix3d& block = blocks_[slot++];
      for (int c = 0; c < 3; ++c) {
        const int begin = row == int32_t(column) ? c : 0;
        for (int r = begin; r < 3; ++r) {
          entries.emplace_back(3 * row + r, 3 * int(column) + c, block(r, c));
        }
      }
    }
  }
  const auto size = Eigen::Index(3 * rows_.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  small_.compute(matrix);
  return small_.info() == Eigen::Success;
}

Eigen::VectorXd BlockCholesky::solve(const Eigen::VectorXd& right) const {
  if (large_) return large_->solve(right);
  return small_.solve(right);
}

}  // namespace ck
