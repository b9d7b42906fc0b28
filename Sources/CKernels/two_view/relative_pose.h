#pragma once

#include <Eigen/Core>
#include <vector>

#include "two_view/matches.h"

namespace ck {

/// Second-from-first with a translation of unit length.
struct RelativePose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::UnitX();

  /// The essential matrix [t]× R, scaled to Frobenius norm 1.
  Eigen::Matrix3d essential() const;
};

/// The skew-symmetric matrix of the cross product with `v`.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// The rotation by |v| radians about v.
Eigen::Matrix3d rotation_exponential(const Eigen::Vector3d& v);

/// Whether a match is in front of both cameras, and its triangulation angle.
struct Triangulation {
  bool in_front = false;
  /// Radians.
  double angle = 0;
};

/// Tests a match by triangulation.
Triangulation triangulate(const RelativePose& pose, const Eigen::Vector2d& first,
                          const Eigen::Vector2d& second);

/// Of the four poses of an essential matrix, the one with most of `indices` in front of both
/// cameras. Other matrices are replaced by the nearest essential matrix.
RelativePose decompose(const Eigen::Matrix3d& essential, const Matches& matches,
                       const std::vector<size_t>& indices);

/// Minimizes Σ min(Sampson error², limit²) by Levenberg–Marquardt over the five parameters of a
/// pose. Returns the sum.
double refine_pose(RelativePose& pose, const Matches& matches, double limit, int iterations);

/// The same over the seven parameters of a fundamental matrix (Bartoli and Sturm, PAMI 2004).
double refine_fundamental(Eigen::Matrix3d& fundamental, const Matches& matches, double limit,
                          int iterations);

}  // namespace ck
