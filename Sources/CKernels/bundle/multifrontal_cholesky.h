#pragma once

#include <vector>

#include "bundle/reduced_system.h"

namespace ck {

/// The sparse Cholesky factorization of a reduced camera system by the multifrontal method (Liu,
/// "The multifrontal method for sparse matrix solution: theory and practice", 1992).
///
/// Poses and cameras are eliminated in an order of approximate minimum degree. Consecutive ones
/// with the same later neighbors form a front, a dense matrix: nearly all work is in dense kernels.
class MultifrontalCholesky {
 public:
  /// Orders the unknowns and finds the fronts. The blocks may have any values.
  explicit MultifrontalCholesky(const ReducedSystem& system);

  /// The number of multiplications of a factorization.
  double work() const { return work_; }

  /// Factorizes the matrix; false if it is not positive definite. The result does not depend on the
  /// number of threads.
  bool factorize(const ck_control* control);

  /// The solution for the right side of the system.
  Eigen::VectorXd solve() const;

 private:
  /// A block of the system: the one at `index` in a row of poses, of poses and cameras, or of
  /// cameras.
  enum class Kind { pose_pose, pose_camera, camera_camera };
  struct Entry {
    Kind kind;
    bool is_transposed;
    size_t row, index;
    /// Where its first unknown is in the front.
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

  /// For each place in the order, later ones.
  using Structure = std::vector<std::vector<int32_t>>;

  void order();
  Structure structure() const;
  void find_fronts(Structure structure);
  void link_fronts();
  void add_entries();
  template <typename Body>
  void for_each_block(Body&& body) const;
  /// Where a place is among the unknowns of a front.
  Eigen::Index offset(const Front& front, size_t place) const;
  bool eliminate(Front& front);
  void add_update(const Front& child, Front& front) const;
  void substitute_forward(const Front& front, Eigen::VectorXd& x) const;
  void substitute_backward(const Front& front, Eigen::VectorXd& x) const;
  /// Adds a block at a position of the lower triangle of a front.
  template <typename Block>
  static void add(const Block& block, Eigen::Index row, Eigen::Index column, Front& front);
  void add(const Entry& entry, Front& front) const;

  size_t node_count() const { return system_.poses.size() + system_.cameras.size(); }
  Eigen::Index node_size(size_t node) const {
    return node < system_.poses.size() ? kPoseSize : kCameraSize;
  }
  Eigen::Index node_offset(size_t node) const {
    const size_t poses = system_.poses.size();
    return node < poses ? system_.pose_offset(node) : system_.camera_offset(node - poses);
  }

  const ReducedSystem& system_;
  /// The pose or camera ("node") at each place of the order, and the reverse.
  std::vector<size_t> nodes_, places_;
  /// The first unknown of each place in the order of elimination, and their number.
  std::vector<Eigen::Index> starts_;
  std::vector<Front> fronts_;
  /// The front of each place.
  std::vector<size_t> front_of_place_;
  /// Fronts whose children are all in earlier levels.
  std::vector<std::vector<size_t>> levels_;
  double work_ = 0;
};

}  // namespace ck
