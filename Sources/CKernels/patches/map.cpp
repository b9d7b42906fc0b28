#include "patches/map.h"

#include <cmath>

namespace ck::patches {

Map::Map(const ck_patch_map& map) : raw(&map) {
  const ck_patch_view& view = map.view;
  width = view.width;
  height = view.height;
  fx = static_cast<float>(view.fx);
  fy = static_cast<float>(view.fy);
  cx = static_cast<float>(view.cx);
  cy = static_cast<float>(view.cy);
  rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(view.rotation).cast<float>();
  translation = Eigen::Map<const Eigen::Vector3d>(view.translation).cast<float>();
}

Vector3 Map::normal(const ck_patch& p, int x, int y) const {
  const Vector3 away(
      p.gradient_x * fx, p.gradient_y * fy,
      p.inverse_depth + p.gradient_x * (cx - x - 0.5f) + p.gradient_y * (cy - y - 0.5f));
  return -(rotation.transpose() * away).normalized();
}

Confirmation confirm(const Map& reference, const Map& other, int x, int y, const Vector3& world,
                     const Vector3& normal, const ck_patch_filter_options& options) {
  Confirmation result;
  const Vector3 seen = other.to_camera(world);
  if (!(seen.z() > 0)) return result;
  const Vector2 pixel = other.project(seen);
  if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < static_cast<float>(other.width) &&
        pixel.y() < static_cast<float>(other.height))) {
    return result;
  }
  result.x = static_cast<int>(pixel.x());
  result.y = static_cast<int>(pixel.y());
  const ck_patch* patch = other.patch(result.x, result.y, options.weak_texture_threshold);
  if (!patch) return result;
  // The other view's plane, continued from the centre of its cell to the very pixel.
  const float w = patch->inverse_depth + patch->gradient_x * (pixel.x() - result.x - 0.5f) +
                  patch->gradient_y * (pixel.y() - result.y - 0.5f);
  const float ratio = w * seen.z();  // this depth over the other's
  if (ratio < 1 - options.contradiction_threshold) result.kind = Confirmation::kSeesThrough;
  if (!(std::fabs(ratio - 1) < options.depth_threshold)) return result;
  if (other.normal(*patch, result.x, result.y).dot(normal) < options.normal_cosine) return result;
  result.point = other.to_world(other.ray(pixel.x(), pixel.y()) / w);
  const Vector3 back = reference.to_camera(result.point);
  result.distance = (reference.project(back) - Vector2(x + 0.5f, y + 0.5f)).norm();
  if (result.distance < options.reprojection_threshold) result.kind = Confirmation::kAgrees;
  return result;
}

}  // namespace ck::patches
