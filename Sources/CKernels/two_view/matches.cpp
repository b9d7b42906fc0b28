#include "two_view/matches.h"

#include <Eigen/Dense>
#include <limits>

namespace ck {

Matches::Matches(const double* first_points, const double* second_points, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    first.emplace_back(first_points[2 * i], first_points[2 * i + 1]);
    second.emplace_back(second_points[2 * i], second_points[2 * i + 1]);
    x1.push_back(first[i].x());
    y1.push_back(first[i].y());
    x2.push_back(second[i].x());
    y2.push_back(second[i].y());
  }
}

void sampson_errors(const Eigen::Matrix3d& m, const Matches& matches, size_t begin, size_t end,
                    double* errors) {
  const double m00 = m(0, 0), m01 = m(0, 1), m02 = m(0, 2), m10 = m(1, 0), m11 = m(1, 1),
               m12 = m(1, 2), m20 = m(2, 0), m21 = m(2, 1), m22 = m(2, 2);
  const double *x1 = matches.x1.data(), *y1 = matches.y1.data(), *x2 = matches.x2.data(),
               *y2 = matches.y2.data();
  for (size_t i = begin; i < end; ++i) {
    const double a = m00 * x1[i] + m01 * y1[i] + m02, b = m10 * x1[i] + m11 * y1[i] + m12;
    const double c = m20 * x1[i] + m21 * y1[i] + m22;
    const double d = m00 * x2[i] + m10 * y2[i] + m20, e = m01 * x2[i] + m11 * y2[i] + m21;
    const double residual = x2[i] * a + y2[i] * b + c;
    const double norm = a * a + b * b + d * d + e * e + std::numeric_limits<double>::min();
    errors[i - begin] = residual * residual / norm;
  }
}

void transfer_errors(const Eigen::Matrix3d& h, const Matches& matches, size_t begin, size_t end,
                     double* errors) {
  for (size_t i = begin; i < end; ++i) {
    const Eigen::Vector3d mapped = h * matches.first[i].homogeneous();
    const Eigen::Vector2d difference = mapped.hnormalized() - matches.second[i];
    const double squared = difference.squaredNorm();
    errors[i - begin] = squared >= 0 ? squared : std::numeric_limits<double>::max();
  }
}

}  // namespace ck
