#pragma once

#include <Eigen/Core>
#include <vector>

namespace ck {

using Matrix3List = std::vector<Eigen::Matrix3d>;

/// All essential matrices through five matches of points at depth 1 (Nistér, PAMI 2004).
void five_point(const Eigen::Vector2d* first, const Eigen::Vector2d* second, Matrix3List& result);

/// All fundamental matrices through seven matches.
void seven_point(const Eigen::Vector2d* first, const Eigen::Vector2d* second, Matrix3List& result);

/// The homography second-from-first of at least four matches by the direct linear transform with
/// Hartley's normalisation; false when the points don't determine one.
bool homography(const std::vector<Eigen::Vector2d>& first,
                const std::vector<Eigen::Vector2d>& second, Eigen::Matrix3d& result);

}  // namespace ck
