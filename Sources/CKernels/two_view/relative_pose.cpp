#include "two_view/relative_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace ck {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix3d rotation_exponential(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity() + cross_matrix(v);
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

Eigen::Matrix3d RelativePose::essential() const {
  return (cross_matrix(translation) * rotation).normalized();
}

Triangulation triangulate(const RelativePose& pose, const Eigen::Vector2d& first,
                          const Eigen::Vector2d& second) {
  // Solves λ₂ d₂ = λ₁ R d₁ + t in the least squares sense.
  const Eigen::Vector3d a = (pose.rotation * first.homogeneous()).normalized();
  const Eigen::Vector3d b = second.homogeneous().normalized();
  const double cosine = a.dot(b), at = a.dot(pose.translation), bt = b.dot(pose.translation);
  Triangulation result;
  result.in_front = bt * cosine - at > 0 && bt - at * cosine > 0;
  result.angle = std::atan2(a.cross(b).norm(), cosine);
  return result;
}

RelativePose decompose(const Eigen::Matrix3d& essential, const Matches& matches,
                       const std::vector<size_t>& indices) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU(), v = svd.matrixV();
  if (u.determinant() < 0) u = -u;
  if (v.determinant() < 0) v = -v;
  Eigen::Matrix3d w;
  w << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  RelativePose best;
  size_t best_count = 0;
  for (int k = 0; k < 4; ++k) {
    RelativePose pose;
    pose.rotation = u * (k < 2 ? w : Eigen::Matrix3d(w.transpose())) * v.transpose();
    pose.translation = (k % 2 == 0 ? 1 : -1) * u.col(2);
    size_t count = 0;
    for (size_t i : indices) {
      count += triangulate(pose, matches.first[i], matches.second[i]).in_front;
    }
    if (k == 0 || count > best_count) {
      best = pose;
      best_count = count;
    }
  }
  return best;
}

}  // namespace ck
