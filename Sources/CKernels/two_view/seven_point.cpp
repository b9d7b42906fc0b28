#include <Eigen/Dense>

#include "two_view/polynomial.h"
#include "two_view/solvers.h"

namespace ck {
namespace {

Eigen::Matrix3d adjugate(const Eigen::Matrix3d& m) {
  Eigen::Matrix3d result;
  result.row(0) = m.col(1).cross(m.col(2));
  result.row(1) = m.col(2).cross(m.col(0));
  result.row(2) = m.col(0).cross(m.col(1));
  return result;
}

}  // namespace

void seven_point(const Eigen::Vector2d* first, const Eigen::Vector2d* second, Matrix3List& result) {
  result.clear();
  Eigen::Matrix<double, 9, 7> constraints;
  for (int i = 0; i < 7; ++i) {
    const Eigen::Vector3d a = first[i].homogeneous(), b = second[i].homogeneous();
    for (int r = 0; r < 3; ++r) constraints.block<3, 1>(3 * r, i) = b[r] * a;
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, 9, 7>> qr(constraints);
  const Eigen::Matrix<double, 9, 9> q = qr.householderQ();
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Matrix3d a = Eigen::Map<const RowMajor>(q.col(7).data());
  const Eigen::Matrix3d b = Eigen::Map<const RowMajor>(q.col(8).data());
  // det(a + λ b)
  const double coefficients[4] = {a.determinant(), (adjugate(a) * b).trace(),
                                  (a * adjugate(b)).trace(), b.determinant()};
  const RealRoots roots = real_roots(coefficients, 3);
  for (int i = 0; i < roots.count; ++i) {
    const Eigen::Matrix3d f = (a + roots.values[i] * b).normalized();
    if (f.allFinite()) result.push_back(f);
  }
}

}  // namespace ck
