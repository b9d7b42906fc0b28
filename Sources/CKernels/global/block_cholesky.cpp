#include "global/block_cholesky.h"

#include <algorithm>

namespace ck {

BlockCholesky::BlockCholesky(size_t size, std::vector<std::pair<int32_t, int32_t>> blocks)
    : rows_(size) {
  for (size_t i = 0; i < size; ++i) rows_[i].push_back(int32_t(i));
  for (const auto& [row, column] : blocks) rows_[size_t(column)].push_back(row);
  size_t slots = 0;
  for (auto& rows : rows_) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    first_slot_.push_back(slots);
    slots += rows.size();
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * slots);
  for (size_t column = 0; column < size; ++column) {
    for (const int32_t row : rows_[column]) {
      for (int c = 0; c < 3; ++c) {
        const int begin = row == int32_t(column) ? c : 0;
        for (int r = begin; r < 3; ++r) entries.emplace_back(3 * row + r, 3 * int(column) + c, 1);
      }
    }
  }
  matrix_.resize(Eigen::Index(3 * size), Eigen::Index(3 * size));
  matrix_.setFromTriplets(entries.begin(), entries.end());
  matrix_.makeCompressed();
  const int* starts = matrix_.outerIndexPtr();
  for (size_t column = 0; column < size; ++column) {
    for (size_t k = 0; k < rows_[column].size(); ++k) {
      Place place;
      place.is_diagonal = k == 0;
      // Column c of the diagonal block holds 3 − c values, the blocks below follow.
      for (int c = 0; c < 3; ++c) {
        place.starts[c] = starts[3 * column + size_t(c)] + (k == 0 ? 0 : 3 * int(k) - c);
      }
      places_.push_back(place);
    }
  }
  solver_.analyzePattern(matrix_);
}

size_t BlockCholesky::slot(int32_t row, int32_t column) const {
  const auto& rows = rows_[size_t(column)];
  return first_slot_[size_t(column)] +
         size_t(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
}

void BlockCholesky::clear() {
  std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
}

void BlockCholesky::add(size_t slot, const Eigen::Matrix3d& block) {
  const Place& place = places_[slot];
  double* values = matrix_.valuePtr();
  for (int c = 0; c < 3; ++c) {
    const int begin = place.is_diagonal ? c : 0;
    for (int r = begin; r < 3; ++r) values[place.starts[c] + r - begin] += block(r, c);
  }
}

bool BlockCholesky::factorize() {
  solver_.factorize(matrix_);
  return solver_.info() == Eigen::Success;
}

Eigen::VectorXd BlockCholesky::solve(const Eigen::VectorXd& right) const {
  return solver_.solve(right);
}

}  // namespace ck
