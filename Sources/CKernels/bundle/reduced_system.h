#pragma once

#include <vector>

#include "bundle/layout.h"
#include "core/eigen_sparse.h"

namespace ck {

/// The reduced camera system: a symmetric matrix of blocks for free poses, then free cameras, and
/// its right side.
///
/// The upper triangle is stored by rows. Which blocks exist follows from the layout: those of poses
/// and cameras that observe a common free point, and of a pose and its camera.
class ReducedSystem {
 public:
  using PosePose = Eigen::Matrix<double, kPoseSize, kPoseSize>;
  using PoseCamera = Eigen::Matrix<double, kPoseSize, kCameraSize>;
  using CameraCamera = Eigen::Matrix<double, kCameraSize, kCameraSize>;

  /// The blocks of one row, in the order of their columns.
  template <typename Block>
  struct Row {
    std::vector<int32_t> columns;
    std::vector<Block> blocks;

    /// The block of a column that the row has.
    Block& at(int32_t column);
    void clear();
  };

  ReducedSystem(const BundleLayout& layout, const ck_control* control);

  /// The number of unknowns.
  Eigen::Index size() const { return camera_offset(cameras.size()); }
  Eigen::Index pose_offset(size_t pose) const { return Eigen::Index(kPoseSize * pose); }
  Eigen::Index camera_offset(size_t camera) const {
    return Eigen::Index(kPoseSize * poses.size() + kCameraSize * camera);
  }

  /// The first unknown of a node: the poses are the first nodes, then come the cameras.
  Eigen::Index offset(size_t node) const {
    return node < poses.size() ? pose_offset(node) : camera_offset(node - poses.size());
  }

  /// Calls `body(row, column, block)` for every block of the upper triangle, with its nodes.
  template <typename Body>
  void for_each_block(Body&& body) const {
    const auto visit = [&](size_t node, const auto& row, size_t first_column) {
      for (size_t k = 0; k < row.columns.size(); ++k) {
        body(node, first_column + size_t(row.columns[k]), row.blocks[k]);
      }
    };
    for (size_t i = 0; i < poses.size(); ++i) {
      visit(i, poses[i], 0);
      visit(i, pose_cameras[i], poses.size());
    }
    for (size_t i = 0; i < cameras.size(); ++i) visit(poses.size() + i, cameras[i], poses.size());
  }

  /// Columns not less than the row, of which the first is the row itself.
  std::vector<Row<PosePose>> poses;
  std::vector<Row<PoseCamera>> pose_cameras;
  std::vector<Row<CameraCamera>> cameras;
  Eigen::VectorXd right;
};

}  // namespace ck
