#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bundle/reprojection.h"
#include "core/span.h"

namespace ck {

/// The values that a bundle adjustment changes.
struct BundleParameters {
  std::vector<ck_camera> cameras;
  std::vector<Eigen::Quaterniond> rotations;
  std::vector<Vector3> translations;
  std::vector<Vector3> points;

  Pose pose(size_t photo) const {
    return {rotations[photo].toRotationMatrix(), translations[photo]};
  }
};

/// Lists of numbers, one behind the other: list i is `values[starts[i]..<starts[i + 1]]`.
struct Lists {
  std::vector<size_t> starts{0};
  std::vector<int32_t> values;

  void end_list() { starts.push_back(values.size()); }

  /// The numbers 0..<`keys.size()` grouped by key, ascending; numbers of negative keys are left
  /// out.
  static Lists grouped(const std::vector<int32_t>& keys, size_t key_count);
};

/// Which unknowns a bundle has and which observations depend on them.
///
/// Free poses, free cameras and points that are observed are numbered in the order of the bundle;
/// these numbers are called blocks.
struct BundleLayout {
  /// An observation; the blocks are −1 for what is constant.
  struct Observation {
    Vector2 pixel;
    /// What residuals are multiplied by.
    Eigen::Matrix2d whitening;
    int32_t photo, camera, point, pose_block, camera_block;
  };

  explicit BundleLayout(const ck_bundle& bundle);

  size_t pose_count() const { return photos.size(); }
  size_t camera_count() const { return cameras.size(); }

  /// Ordered by point.
  std::vector<Observation> observations;
  /// The first observation of each point, and the end of the last.
  std::vector<size_t> point_starts;
  std::vector<bool> is_point_free;
  /// Photos of the free poses, and cameras with a free parameter.
  std::vector<size_t> photos, cameras;
  /// For each free pose, the component of the translation that is constant, or −1.
  std::vector<int> fixed_axes;
  /// For each free camera, which of its parameters are free.
  std::vector<std::array<bool, kCameraSize>> free_parameters;
  /// The free cameras of the observations of each free point, ascending ("links").
  Lists cameras_of_point;
  /// The point of each link.
  std::vector<int32_t> link_points;
  /// The observations of each free pose, and the links of each free camera.
  Lists observations_of_pose, links_of_camera;
  /// The observations of each free camera.
  Lists observations_of_camera;

 private:
  void number_poses(const ck_bundle& bundle, const std::vector<bool>& used);
  void number_cameras(const ck_bundle& bundle, const std::vector<bool>& used);
  void sort_observations(const ck_bundle& bundle);
  void link_cameras();
};

}  // namespace ck
