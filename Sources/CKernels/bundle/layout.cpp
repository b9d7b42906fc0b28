#include "bundle/layout.h"

#include <algorithm>
#include <numeric>

#include "core/guard.h"

namespace ck {
namespace {

/// The component of a photo's translation that changes most when the world is scaled about the
/// first constant photo: the derivative of the translation is that photo's center in this photo's
/// frame.
int scale_axis(const ck_bundle& bundle, const std::vector<bool>& used, size_t photo) {
  Vector3 center = Vector3::Zero();
  for (size_t i = 0; i < bundle.photo_count; ++i) {
    if (!used[i] || bundle.pose_freedom[i] != ck_pose_constant) continue;
    center = pose_from(bundle.poses[i]).center();
    break;
  }
  int axis = 0;
  (pose_from(bundle.poses[photo]) * center).cwiseAbs().maxCoeff(&axis);
  return axis;
}

}  // namespace

Lists Lists::grouped(const std::vector<int32_t>& keys, size_t key_count) {
  Lists lists;
  lists.starts.assign(key_count + 1, 0);
  for (const int32_t key : keys) {
    if (key >= 0) ++lists.starts[size_t(key) + 1];
  }
  std::partial_sum(lists.starts.begin(), lists.starts.end(), lists.starts.begin());
  lists.values.resize(lists.starts.back());
  std::vector<size_t> next(lists.starts.begin(), lists.starts.end() - 1);
  for (size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] >= 0) lists.values[next[size_t(keys[i])]++] = int32_t(i);
  }
  return lists;
}

BundleLayout::BundleLayout(const ck_bundle& bundle) {
  std::vector<bool> used_photos(bundle.photo_count), used_cameras(bundle.camera_count);
  for (size_t i = 0; i < bundle.observation_count; ++i) {
    const ck_observation& o = bundle.observations[i];
    require(o.photo >= 0 && size_t(o.photo) < bundle.photo_count && o.point >= 0 &&
                size_t(o.point) < bundle.points.count,
            "an observation refers to a photo or point that does not exist");
    const int32_t camera = bundle.photo_cameras[o.photo];
    require(camera >= 0 && size_t(camera) < bundle.camera_count,
            "a photo refers to a camera that does not exist");
    used_photos[size_t(o.photo)] = true;
    used_cameras[size_t(camera)] = true;
  }
  number_poses(bundle, used_photos);
  number_cameras(bundle, used_cameras);
  sort_observations(bundle);
  link_cameras();
}

void BundleLayout::number_poses(const ck_bundle& bundle, const std::vector<bool>& used) {
  for (size_t i = 0; i < bundle.photo_count; ++i) {
    if (!used[i] || bundle.pose_freedom[i] == ck_pose_constant) continue;
    photos.push_back(i);
    fixed_axes.push_back(bundle.pose_freedom[i] == ck_pose_scale_fixed ? scale_axis(bundle, used, i)
                                                                       : -1);
  }
}

void BundleLayout::number_cameras(const ck_bundle& bundle, const std::vector<bool>& used) {
  constexpr uint32_t bits[kCameraSize] = {
      ck_free_focal_length, ck_free_principal_point, ck_free_principal_point, ck_free_k1,
      ck_free_k2,           ck_free_tangential,      ck_free_tangential};
  for (size_t i = 0; i < bundle.camera_count; ++i) {
    if (!used[i]) continue;
    require(bundle.cameras[i].fx > 0 && bundle.cameras[i].fy > 0, "a camera has no focal length");
    std::array<bool, kCameraSize> free;
    for (size_t k = 0; k < kCameraSize; ++k) free[k] = bundle.camera_freedom[i] & bits[k];
    if (std::find(free.begin(), free.end(), true) == free.end()) continue;
    cameras.push_back(i);
    free_parameters.push_back(free);
  }
}

void BundleLayout::sort_observations(const ck_bundle& bundle) {
  std::vector<int32_t> pose_blocks(bundle.photo_count, -1), camera_blocks(bundle.camera_count, -1);
  for (size_t i = 0; i < photos.size(); ++i) pose_blocks[photos[i]] = int32_t(i);
  for (size_t i = 0; i < cameras.size(); ++i) camera_blocks[cameras[i]] = int32_t(i);
  std::vector<int32_t> points(bundle.observation_count);
  for (size_t i = 0; i < points.size(); ++i) points[i] = bundle.observations[i].point;
  const Lists by_point = Lists::grouped(points, bundle.points.count);
  point_starts = by_point.starts;

  std::vector<int32_t> poses, camera_keys;
  observations.reserve(points.size());
  poses.reserve(points.size());
  camera_keys.reserve(points.size());
  for (const int32_t index : by_point.values) {
    const ck_observation& o = bundle.observations[index];
    const int32_t camera = bundle.photo_cameras[o.photo];
    const Eigen::Matrix2d whitening{{o.xx, o.xy}, {0, o.yy}};
    observations.push_back({Vector2(o.x, o.y), whitening, o.photo, camera, o.point,
                            pose_blocks[size_t(o.photo)], camera_blocks[size_t(camera)]});
    poses.push_back(observations.back().pose_block);
    camera_keys.push_back(observations.back().camera_block);
  }
  observations_of_pose = Lists::grouped(poses, photos.size());
  observations_of_camera = Lists::grouped(camera_keys, cameras.size());
  is_point_free.resize(bundle.points.count);
  for (size_t i = 0; i < bundle.points.count; ++i) is_point_free[i] = bundle.point_freedom[i];
}

void BundleLayout::link_cameras() {
  for (size_t point = 0; point < is_point_free.size(); ++point) {
    std::vector<int32_t>& all = cameras_of_point.values;
    const auto first = std::ptrdiff_t(all.size());
    for (size_t k = point_starts[point]; is_point_free[point] && k < point_starts[point + 1]; ++k) {
      const int32_t camera = observations[k].camera_block;
      if (camera >= 0 && std::find(all.begin() + first, all.end(), camera) == all.end()) {
        all.push_back(camera);
      }
    }
    std::sort(all.begin() + first, all.end());
    link_points.resize(all.size(), int32_t(point));
    cameras_of_point.end_list();
  }
  links_of_camera = Lists::grouped(cameras_of_point.values, cameras.size());
}

}  // namespace ck
