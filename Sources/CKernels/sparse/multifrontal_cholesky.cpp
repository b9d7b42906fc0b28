#include "sparse/multifrontal_cholesky.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>

#include "core/parallel.h"

namespace ck {
namespace {

/// Multiplications for which a thread is started. Chosen: they take as long as starting it; results
/// do not depend on it.
constexpr double kWorkPerThread = 1e5;

}  // namespace

MultifrontalCholesky::MultifrontalCholesky(BlockPattern pattern) : pattern_(std::move(pattern)) {
  Eigen::Index offset = 0;
  for (const Eigen::Index size : pattern_.sizes) {
    offsets_.push_back(offset);
    offset += size;
  }
  order();
  find_fronts(structure());
  link_fronts();
}

/// Orders the nodes by approximate minimum degree.
void MultifrontalCholesky::order() {
  std::vector<Eigen::Triplet<char>> links;
  for (const auto& [row, column] : pattern_.blocks) {
    links.emplace_back(int(std::min(row, column)), int(std::max(row, column)), 1);
  }
  const auto count = Eigen::Index(node_count());
  Eigen::SparseMatrix<char> pattern(count, count);
  pattern.setFromTriplets(links.begin(), links.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Upper>(), permutation);
  nodes_.assign(permutation.indices().begin(), permutation.indices().end());
  places_.resize(nodes_.size());
  starts_.assign(1, 0);
  for (size_t place = 0; place < nodes_.size(); ++place) {
    places_[nodes_[place]] = place;
    starts_.push_back(starts_.back() + node_size(nodes_[place]));
  }
}

/// For each place, the later ones with which it is linked once those before it are eliminated.
MultifrontalCholesky::Structure MultifrontalCholesky::structure() const {
  Structure found(node_count());
  for (const auto& [row, column] : pattern_.blocks) {
    const auto [low, high] = std::minmax(places_[row], places_[column]);
    if (low != high) found[low].push_back(int32_t(high));
  }
  for (auto& own : found) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (own.empty()) continue;
    auto& parent = found[size_t(own.front())];
    parent.insert(parent.end(), own.begin() + 1, own.end());
  }
  return found;
}

/// Joins consecutive places whose later neighbors are the same.
void MultifrontalCholesky::find_fronts(Structure structure) {
  for (size_t place = 0; place < structure.size(); ++place) {
    std::vector<int32_t>& rows = structure[place];
    const bool continues = !fronts_.empty() && fronts_.back().rows.size() == rows.size() + 1 &&
                           size_t(fronts_.back().rows.front()) == place;
    if (!continues) {
      fronts_.emplace_back();
      fronts_.back().begin = place;
    }
    Front& front = fronts_.back();
    front.end = place + 1;
    front.rows = std::move(rows);
    front_of_place_.push_back(fronts_.size() - 1);
  }
}

/// Finds the parents of the fronts, their levels and their work.
void MultifrontalCholesky::link_fronts() {
  std::vector<size_t> level_of_front(fronts_.size(), 0);
  for (size_t i = 0; i < fronts_.size(); ++i) {
    Front& front = fronts_[i];
    front.pivots = starts_[front.end] - starts_[front.begin];
    for (const int32_t row : front.rows) front.updates += node_size(nodes_[size_t(row)]);
    double work = 0;
    for (Eigen::Index k = 0; k < front.pivots; ++k) {
      const auto height = double(front.pivots - k + front.updates);
      work += height * height / 2;
    }
    work_ += work;
    for (const size_t child : front.children) {
      level_of_front[i] = std::max(level_of_front[i], level_of_front[child] + 1);
      for (const int32_t row : fronts_[child].rows) {
        fronts_[child].targets.push_back(offset(front, size_t(row)));
      }
    }
    levels_.resize(std::max(levels_.size(), level_of_front[i] + 1));
    levels_[level_of_front[i]].fronts.push_back(i);
    levels_[level_of_front[i]].work += work;
    if (!front.rows.empty()) {
      fronts_[front_of_place_[size_t(front.rows.front())]].children.push_back(i);
    }
  }
}

Eigen::Index MultifrontalCholesky::offset(const Front& front, size_t place) const {
  if (place < front.end) return starts_[place] - starts_[front.begin];
  Eigen::Index result = front.pivots;
  for (const int32_t row : front.rows) {
    if (size_t(row) == place) break;
    result += node_size(nodes_[size_t(row)]);
  }
  return result;
}

/// Assigns each block to the front that eliminates it.
void MultifrontalCholesky::add_entries() {
  for (size_t i = 0; i < pattern_.blocks.size(); ++i) {
    const auto& [row, column] = pattern_.blocks[i];
    const auto [low, high] = std::minmax(places_[row], places_[column]);
    Front& front = fronts_[front_of_place_[low]];
    front.entries.push_back(
        {i, low == places_[row], offset(front, high), starts_[low] - starts_[front.begin]});
  }
}

bool MultifrontalCholesky::factorize(const std::vector<const double*>& values,
                                     const ck_control* control) {
  // Not needed if only the work is asked for, and large where all photos show the same points.
  if (fronts_.front().entries.empty()) add_entries();
  std::atomic<bool> succeeds{true};
  for (const Level& level : levels_) {
    const double useful = std::max(1.0, level.work / kWorkPerThread);
    const int threads = int(std::min<double>(thread_count(control), useful));
    const ck_control quiet{nullptr, nullptr, threads};
    parallel_for(&quiet, level.fronts.size(), [&](size_t i) {
      if (!eliminate(fronts_[level.fronts[i]], values)) succeeds.store(false);
    });
  }
  return succeeds.load();
}

/// Assembles a front, and eliminates its pivots.
bool MultifrontalCholesky::eliminate(Front& front, const std::vector<const double*>& values) {
  const Eigen::Index pivots = front.pivots, updates = front.updates;
  front.columns.setZero(pivots + updates, pivots);
  front.update.setZero(updates, updates);
  for (const Entry& entry : front.entries) add(entry, values[entry.block], front);
  for (const size_t child : front.children) {
    add_update(fronts_[child], front);
    fronts_[child].update.resize(0, 0);
  }
  auto top = front.columns.topRows(pivots);
  auto bottom = front.columns.bottomRows(updates);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> pivot(top);
  if (pivot.info() != Eigen::Success) return false;
  if (updates == 0) return true;
  top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(bottom);
  front.update.selfadjointView<Eigen::Lower>().rankUpdate(bottom, -1);
  return true;
}

/// Adds the update of a child to its parent.
void MultifrontalCholesky::add_update(const Front& child, Front& front) const {
  Eigen::Index column_start = 0;
  for (size_t column = 0; column < child.rows.size(); ++column) {
    const Eigen::Index width = node_size(nodes_[size_t(child.rows[column])]);
    Eigen::Index row_start = column_start;
    for (size_t row = column; row < child.rows.size(); ++row) {
      const Eigen::Index height = node_size(nodes_[size_t(child.rows[row])]);
      add(child.update.block(row_start, column_start, height, width), child.targets[row],
          child.targets[column], front);
      row_start += height;
    }
    column_start += width;
  }
}

template <typename Block>
void MultifrontalCholesky::add(const Block& block, Eigen::Index row, Eigen::Index column,
                               Front& front) {
  if (column < front.pivots) {
    front.columns.block(row, column, block.rows(), block.cols()) += block;
  } else {
    front.update.block(row - front.pivots, column - front.pivots, block.rows(), block.cols()) +=
        block;
  }
}

void MultifrontalCholesky::add(const Entry& entry, const double* values, Front& front) const {
  const auto& [row, column] = pattern_.blocks[entry.block];
  const Eigen::Map<const Eigen::MatrixXd> block(values, node_size(row), node_size(column));
  if (entry.is_transposed) {
    add(block.transpose(), entry.front_row, entry.front_column, front);
  } else {
    add(block, entry.front_row, entry.front_column, front);
  }
}

Eigen::VectorXd MultifrontalCholesky::solve(const Eigen::VectorXd& right) const {
  Eigen::VectorXd x(right.size()), solution(right.size());
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Index size = node_size(nodes_[i]);
    x.segment(starts_[i], size) = right.segment(offsets_[nodes_[i]], size);
  }
  for (const Front& front : fronts_) substitute_forward(front, x);
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    substitute_backward(*front, x);
  }
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Index size = node_size(nodes_[i]);
    solution.segment(offsets_[nodes_[i]], size) = x.segment(starts_[i], size);
  }
  return solution;
}

/// Solves for the pivots of a front, and removes them from the later equations.
void MultifrontalCholesky::substitute_forward(const Front& front, Eigen::VectorXd& x) const {
  auto own = x.segment(starts_[front.begin], front.pivots);
  front.columns.topRows(front.pivots).triangularView<Eigen::Lower>().solveInPlace(own);
  const Eigen::VectorXd change = front.columns.bottomRows(front.updates) * own;
  Eigen::Index start = 0;
  for (const int32_t row : front.rows) {
    const Eigen::Index size = node_size(nodes_[size_t(row)]);
    x.segment(starts_[size_t(row)], size) -= change.segment(start, size);
    start += size;
  }
}

/// Solves for the pivots of a front with the transposed factor.
void MultifrontalCholesky::substitute_backward(const Front& front, Eigen::VectorXd& x) const {
  Eigen::VectorXd later(front.updates);
  Eigen::Index start = 0;
  for (const int32_t row : front.rows) {
    const Eigen::Index size = node_size(nodes_[size_t(row)]);
    later.segment(start, size) = x.segment(starts_[size_t(row)], size);
    start += size;
  }
  auto own = x.segment(starts_[front.begin], front.pivots);
  own -= front.columns.bottomRows(front.updates).transpose() * later;
  front.columns.topRows(front.pivots).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
}

}  // namespace ck
