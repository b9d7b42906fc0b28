#pragma once

#include <Eigen/Core>
#include <vector>

namespace ck {

using Matrix3List = std::vector<Eigen::Matrix3d>;

/// All essential matrices determined by five matches of points at depth 1 (Nistér, PAMI 2004).
void five_point(const Eigen::Vector2d* first, const Eigen::Vector2d* second, Matrix3List& result);

/// All fundamental matrices determined by seven matches.
void seven_point(const Eigen::Vector2d* first, const Eigen::Vector2d* second, Matrix3List& result);

/// The homography second-from-first of at least four matches, by the direct linear transform with
/// Hartley's normalization; false if the points do not determine one.
bool homography(const std::vector<Eigen::Vector2d>& first,
                const std::vector<Eigen::Vector2d>& second, Eigen::Matrix3d& result);

}  // namespace ck
