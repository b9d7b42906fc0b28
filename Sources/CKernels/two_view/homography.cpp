#include <Eigen/Dense>
#include <cmath>

#include "two_view/solvers.h"

namespace ck {
namespace {

/// Hartley's normalization: moves the mean of the points to the origin and scales their mean
/// distance from it to √2.
Eigen::Matrix3d normalization(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  double distance = 0;
  for (const auto& p : points) distance += (p - mean).norm();
  distance /= static_cast<double>(points.size());
  const double scale = distance > 0 ? std::sqrt(2.0) / distance : 1;
  Eigen::Matrix3d result;
  result << scale, 0, -scale * mean.x(), 0, scale, -scale * mean.y(), 0, 0, 1;
  return result;
}

}  // namespace

bool homography(const std::vector<Eigen::Vector2d>& first,
                const std::vector<Eigen::Vector2d>& second, Eigen::Matrix3d& result) {
  const Eigen::Matrix3d a = normalization(first), b = normalization(second);
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (size_t i = 0; i < first.size(); ++i) {
    const Eigen::Vector3d p = a * first[i].homogeneous(), q = b * second[i].homogeneous();
    Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
    rows.block<1, 3>(0, 0) = p.transpose();
    rows.block<1, 3>(0, 6) = -q.x() * p.transpose();
    rows.block<1, 3>(1, 3) = p.transpose();
    rows.block<1, 3>(1, 6) = -q.y() * p.transpose();
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  // With a second null direction the points do not determine the homography.
  if (!(solver.eigenvalues()[1] > 1e-12 * solver.eigenvalues()[8])) return false;
  const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
  const Eigen::Matrix3d m =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(h.data());
  result = b.inverse() * m * a;
  return result.allFinite() && std::abs(result.determinant()) > 1e-12 * std::pow(result.norm(), 3);
}

}  // namespace ck
