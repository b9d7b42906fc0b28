#pragma once

#include <cstdint>
#include <vector>

#include "ck_core.h"
#include "core/eigen_sparse.h"

namespace ck {

/// Which blocks a symmetric matrix has. Its unknowns are in groups, the nodes.
struct BlockPattern {
  /// The block of two nodes.
  struct Block {
    size_t row, column;
  };

  /// The number of unknowns of each node.
  std::vector<Eigen::Index> sizes;
  /// Those of one triangle, in any order; that of each node with itself is one of them.
  std::vector<Block> blocks;
};

/// The sparse Cholesky factorization of a matrix of blocks by the multifrontal method (Liu, "The
/// multifrontal method for sparse matrix solution: theory and practice", 1992).
///
/// Nodes are eliminated in an order of approximate minimum degree. Consecutive ones with the same
/// later neighbors form a front, a dense matrix: nearly all work is in dense kernels.
class MultifrontalCholesky {
 public:
  /// Orders the nodes and finds the fronts.
  explicit MultifrontalCholesky(BlockPattern pattern);

  /// The number of multiplications of a factorization.
  double work() const { return work_; }

  /// Factorizes the matrix whose blocks have these values, column by column, in the order of the
  /// pattern; false if it is not positive definite. The result does not depend on the number of
  /// threads.
  bool factorize(const std::vector<const double*>& values, const ck_control* control);

  /// Solves for a right side with the last factorization.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  /// A block of the matrix, by its number, and where its first unknown is in the front.
  struct Entry {
    size_t block;
    bool is_transposed;
    Eigen::Index front_row, front_column;
  };

  /// Consecutive unknowns that are eliminated together, and the later ones that they are linked
  /// with, which get an update.
  struct Front {
    /// Places in the order of elimination.
    size_t begin = 0, end = 0;
    std::vector<int32_t> rows;
    /// Numbers of unknowns.
    Eigen::Index pivots = 0, updates = 0;
    std::vector<Entry> entries;
    std::vector<size_t> children;
    /// Where each of `rows` is in the front of the parent.
    std::vector<Eigen::Index> targets;
    /// The columns of the factor, and what remains to be added to the parent.
    Eigen::MatrixXd columns, update;
  };

  /// Fronts whose children are all in earlier levels, and the multiplications that they take.
  struct Level {
    std::vector<size_t> fronts;
    double work = 0;
  };

  /// For each place in the order, later ones.
  using Structure = std::vector<std::vector<int32_t>>;

  void order();
  Structure structure() const;
  void find_fronts(Structure structure);
  void link_fronts();
  void add_entries();
  /// Where a place is among the unknowns of a front.
  Eigen::Index offset(const Front& front, size_t place) const;
  bool eliminate(Front& front, const std::vector<const double*>& values);
  void add_update(const Front& child, Front& front) const;
  void substitute_forward(const Front& front, Eigen::VectorXd& x) const;
  void substitute_backward(const Front& front, Eigen::VectorXd& x) const;
  /// Adds a block at a position of the lower triangle of a front.
  template <typename Block>
  static void add(const Block& block, Eigen::Index row, Eigen::Index column, Front& front);
  void add(const Entry& entry, const double* values, Front& front) const;

  size_t node_count() const { return pattern_.sizes.size(); }
  Eigen::Index node_size(size_t node) const { return pattern_.sizes[node]; }

  const BlockPattern pattern_;
  /// The first unknown of each node.
  std::vector<Eigen::Index> offsets_;
  /// The node at each place of the order, and the reverse.
  std::vector<size_t> nodes_, places_;
  /// The first unknown of each place in the order of elimination, and their number.
  std::vector<Eigen::Index> starts_;
  std::vector<Front> fronts_;
  /// The front of each place.
  std::vector<size_t> front_of_place_;
  std::vector<Level> levels_;
  double work_ = 0;
};

}  // namespace ck
