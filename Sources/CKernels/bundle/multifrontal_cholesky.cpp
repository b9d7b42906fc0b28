#include "bundle/multifrontal_cholesky.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>

#include "core/parallel.h"

namespace ck {

MultifrontalCholesky::MultifrontalCholesky(const ReducedSystem& system) : system_(system) {
  order();
  find_fronts(structure());
  link_fronts();
}

/// Calls `body(kind, row, index, row_node, column_node)` for every block of the system.
template <typename Body>
void MultifrontalCholesky::for_each_block(Body&& body) const {
  const size_t poses = system_.poses.size();
  const auto visit = [&](Kind kind, const std::vector<int32_t>& columns, size_t row,
                         size_t row_node, size_t first_column) {
    for (size_t k = 0; k < columns.size(); ++k) {
      body(kind, row, k, row_node, first_column + size_t(columns[k]));
    }
  };
  for (size_t i = 0; i < poses; ++i) {
    visit(Kind::pose_pose, system_.poses[i].columns, i, i, 0);
    visit(Kind::pose_camera, system_.pose_cameras[i].columns, i, i, poses);
  }
  for (size_t i = 0; i < system_.cameras.size(); ++i) {
    visit(Kind::camera_camera, system_.cameras[i].columns, i, poses + i, poses);
  }
}

/// Orders the nodes by approximate minimum degree.
void MultifrontalCholesky::order() {
  std::vector<Eigen::Triplet<char>> links;
  for_each_block([&](Kind, size_t, size_t, size_t row_node, size_t column_node) {
    links.emplace_back(int(row_node), int(column_node), 1);
  });
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
  for_each_block([&](Kind, size_t, size_t, size_t row_node, size_t column_node) {
    const auto [low, high] = std::minmax(places_[row_node], places_[column_node]);
    if (low != high) found[low].push_back(int32_t(high));
  });
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
    for (Eigen::Index k = 0; k < front.pivots; ++k) {
      const auto height = double(front.pivots - k + front.updates);
      work_ += height * height / 2;
    }
    for (const size_t child : front.children) {
      level_of_front[i] = std::max(level_of_front[i], level_of_front[child] + 1);
      for (const int32_t row : fronts_[child].rows) {
        fronts_[child].targets.push_back(offset(front, size_t(row)));
      }
    }
    levels_.resize(std::max(levels_.size(), level_of_front[i] + 1));
    levels_[level_of_front[i]].push_back(i);
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

/// Assigns each block of the system to the front that eliminates it.
void MultifrontalCholesky::add_entries() {
  for_each_block([&](Kind kind, size_t row, size_t index, size_t row_node, size_t column_node) {
    const auto [low, high] = std::minmax(places_[row_node], places_[column_node]);
    Front& front = fronts_[front_of_place_[low]];
    front.entries.push_back({kind, low == places_[row_node], row, index, offset(front, high),
                             starts_[low] - starts_[front.begin]});
  });
}

bool MultifrontalCholesky::factorize(const ck_control* control) {
  // Not needed if only the work is asked for, and large where all photos show the same points.
  if (fronts_.front().entries.empty()) add_entries();
  const ck_control quiet{nullptr, nullptr, thread_count(control)};
  std::atomic<bool> succeeds{true};
  for (const auto& level : levels_) {
    parallel_for(&quiet, level.size(), [&](size_t i) {
      if (!eliminate(fronts_[level[i]])) succeeds.store(false);
    });
  }
  return succeeds.load();
}

/// Assembles a front, and eliminates its pivots.
bool MultifrontalCholesky::eliminate(Front& front) {
  const Eigen::Index pivots = front.pivots, updates = front.updates;
  front.columns.setZero(pivots + updates, pivots);
  front.update.setZero(updates, updates);
  for (const Entry& entry : front.entries) add(entry, front);
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

void MultifrontalCholesky::add(const Entry& entry, Front& front) const {
  const auto add_block = [&](const auto& block) {
    if (entry.is_transposed) {
      add(block.transpose(), entry.front_row, entry.front_column, front);
    } else {
      add(block, entry.front_row, entry.front_column, front);
    }
  };
  switch (entry.kind) {
    case Kind::pose_pose:
      return add_block(system_.poses[entry.row].blocks[entry.index]);
    case Kind::pose_camera:
      return add_block(system_.pose_cameras[entry.row].blocks[entry.index]);
    case Kind::camera_camera:
      return add_block(system_.cameras[entry.row].blocks[entry.index]);
  }
}

Eigen::VectorXd MultifrontalCholesky::solve() const {
  Eigen::VectorXd x(system_.size()), solution(system_.size());
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Index size = node_size(nodes_[i]);
    x.segment(starts_[i], size) = system_.right.segment(node_offset(nodes_[i]), size);
  }
  for (const Front& front : fronts_) substitute_forward(front, x);
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    substitute_backward(*front, x);
  }
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Eigen::Index size = node_size(nodes_[i]);
    solution.segment(node_offset(nodes_[i]), size) = x.segment(starts_[i], size);
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
