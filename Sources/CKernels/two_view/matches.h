#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace ck {

/// Matches as points at depth 1, also as a structure of arrays for the scoring loops.
struct Matches {
  std::vector<Eigen::Vector2d> first, second;
  std::vector<double> x1, y1, x2, y2;

  Matches(const double* first_points, const double* second_points, size_t count);

  size_t size() const { return first.size(); }
};

/// Writes the squared Sampson errors of matches begin..<end to `errors`.
void sampson_errors(const Eigen::Matrix3d& matrix, const Matches& matches, size_t begin, size_t end,
                    double* errors);

/// Writes the squared distances of the second points to the mapped first points (transfer error).
void transfer_errors(const Eigen::Matrix3d& homography, const Matches& matches, size_t begin,
                     size_t end, double* errors);

}  // namespace ck
