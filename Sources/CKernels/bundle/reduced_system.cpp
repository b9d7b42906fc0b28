#include "bundle/reduced_system.h"

#include <algorithm>

#include "core/parallel.h"

namespace ck {
namespace {

/// Number of columns with duplicates that a list has room for in any case. Chosen.
constexpr size_t kRoom = 256;

/// Sorts `columns` and removes duplicates.
void make_unique(std::vector<int32_t>& columns) {
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

/// Removes duplicates once a list has doubled, so that it stays near its final length.
void append(int32_t column, size_t& limit, std::vector<int32_t>& columns) {
  if (!columns.empty() && columns.back() == column) return;
  columns.push_back(column);
  if (columns.size() < limit) return;
  make_unique(columns);
  limit = 2 * columns.size() + kRoom;
}

/// The poses and cameras with which a pose shares a block.
void find_neighbors(const BundleLayout& layout, size_t pose, std::vector<int32_t>& poses,
                    std::vector<int32_t>& cameras) {
  poses.push_back(int32_t(pose));
  size_t pose_limit = kRoom, camera_limit = kRoom;
  const Lists& own = layout.observations_of_pose;
  for (size_t i = own.starts[pose]; i < own.starts[pose + 1]; ++i) {
    const auto& observation = layout.observations[size_t(own.values[i])];
    const auto point = size_t(observation.point);
    if (observation.camera_block >= 0) append(observation.camera_block, camera_limit, cameras);
    if (!layout.is_point_free[point]) continue;
    for (size_t k = layout.point_starts[point]; k < layout.point_starts[point + 1]; ++k) {
      const auto& other = layout.observations[k];
      if (other.pose_block > int32_t(pose)) append(other.pose_block, pose_limit, poses);
      if (other.camera_block >= 0) append(other.camera_block, camera_limit, cameras);
    }
  }
  make_unique(poses);
  make_unique(cameras);
}

/// The cameras with which a camera shares a block.
void find_neighbors(const BundleLayout& layout, size_t camera, std::vector<int32_t>& cameras) {
  cameras.push_back(int32_t(camera));
  size_t limit = kRoom;
  const Lists& links = layout.links_of_camera;
  const Lists& all = layout.cameras_of_point;
  for (size_t i = links.starts[camera]; i < links.starts[camera + 1]; ++i) {
    const auto point = size_t(layout.link_points[size_t(links.values[i])]);
    for (size_t k = all.starts[point]; k < all.starts[point + 1]; ++k) {
      if (all.values[k] > int32_t(camera)) append(all.values[k], limit, cameras);
    }
  }
  make_unique(cameras);
}

}  // namespace

template <typename Block>
Block& ReducedSystem::Row<Block>::at(int32_t column) {
  return blocks[size_t(std::lower_bound(columns.begin(), columns.end(), column) - columns.begin())];
}

template <typename Block>
void ReducedSystem::Row<Block>::clear() {
  blocks.assign(columns.size(), Block::Zero());
}

template struct ReducedSystem::Row<ReducedSystem::PosePose>;
template struct ReducedSystem::Row<ReducedSystem::PoseCamera>;
template struct ReducedSystem::Row<ReducedSystem::CameraCamera>;

ReducedSystem::ReducedSystem(const BundleLayout& layout, const ck_control* control)
    : poses(layout.pose_count()),
      pose_cameras(layout.pose_count()),
      cameras(layout.camera_count()) {
  const ck_control quiet{nullptr, nullptr, thread_count(control)};
  parallel_for(&quiet, poses.size() + cameras.size(), [&](size_t row) {
    if (row < poses.size()) {
      find_neighbors(layout, row, poses[row].columns, pose_cameras[row].columns);
    } else {
      find_neighbors(layout, row - poses.size(), cameras[row - poses.size()].columns);
    }
  });
  right = Eigen::VectorXd::Zero(size());
}

}  // namespace ck
