#include <Eigen/Dense>
#include <cmath>

#include "two_view/polynomial.h"
#include "two_view/solvers.h"

namespace ck {
namespace {

// Polynomials in x, y, z. Degree 1: x y z 1. Degree 2: x² xy xz x y² yz y z² z 1.
// Degree 3: x³ y³ x²y xy² x²z x² y²z y² xyz xy | xz² xz x yz² yz y z³ z² z 1.
using Linear = Eigen::Matrix<double, 1, 4>;
using Quadratic = Eigen::Matrix<double, 1, 10>;
using Cubic = Eigen::Matrix<double, 1, 20>;

// Limit: the positions of products of monomials: of degrees 1 and 1, and of degrees 1 and 2.
constexpr int kSquare[4][4] = {{0, 1, 2, 3}, {1, 4, 5, 6}, {2, 5, 7, 8}, {3, 6, 8, 9}};
constexpr int kCube[4][10] = {{0, 2, 4, 5, 3, 8, 9, 10, 11, 12},
                              {2, 3, 8, 9, 1, 6, 7, 13, 14, 15},
                              {4, 8, 10, 11, 6, 13, 14, 16, 17, 18},
                              {5, 9, 11, 12, 7, 14, 15, 17, 18, 19}};

Quadratic product(const Linear& a, const Linear& b) {
  Quadratic result = Quadratic::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) result[kSquare[i][j]] += a[i] * b[j];
  }
  return result;
}

Cubic product(const Quadratic& a, const Linear& b) {
  Cubic result = Cubic::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 10; ++j) result[kCube[i][j]] += b[i] * a[j];
  }
  return result;
}

using Basis = Eigen::Matrix<double, 9, 4>;

/// Four row-major matrices whose linear combinations are all solutions of the epipolar constraints.
Basis null_space(const Eigen::Vector2d* first, const Eigen::Vector2d* second) {
  Eigen::Matrix<double, 9, 5> constraints;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d a = first[i].homogeneous(), b = second[i].homogeneous();
    for (int r = 0; r < 3; ++r) constraints.block<3, 1>(3 * r, i) = b[r] * a;
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, 9, 5>> qr(constraints);
  Eigen::Matrix<double, 9, 9> q = qr.householderQ();
  return q.rightCols<4>();
}

/// det E = 0 and (E Eᵀ − ½ tr(E Eᵀ)) E = 0 in coordinates of the null space.
Eigen::Matrix<double, 10, 20> constraints(const Basis& basis) {
  auto e = [&](int r, int c) -> Linear { return basis.row(3 * r + c); };
  Quadratic square[3][3];
  for (int r = 0; r < 3; ++r) {
    for (int c = r; c < 3; ++c) {
      square[r][c] =
          product(e(r, 0), e(c, 0)) + product(e(r, 1), e(c, 1)) + product(e(r, 2), e(c, 2));
      square[c][r] = square[r][c];
    }
  }
  const Quadratic half_trace = 0.5 * (square[0][0] + square[1][1] + square[2][2]);
  for (int r = 0; r < 3; ++r) square[r][r] -= half_trace;
  Eigen::Matrix<double, 10, 20> rows;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      rows.row(3 * r + c) = product(square[r][0], e(0, c)) + product(square[r][1], e(1, c)) +
                            product(square[r][2], e(2, c));
    }
  }
  auto minor = [&](int a, int b) -> Quadratic {
    return product(e(1, a), e(2, b)) - product(e(1, b), e(2, a));
  };
  rows.row(9) =
      product(minor(1, 2), e(0, 0)) - product(minor(0, 2), e(0, 1)) + product(minor(0, 1), e(0, 2));
  return rows;
}

/// Coefficients of a polynomial in z, constant term first.
using InZ = std::array<double, kMaximumDegree + 1>;

/// Adds sign · a · b · c.
void add_product(InZ& sum, double sign, const InZ& a, int da, const InZ& b, int db, const InZ& c,
                 int dc) {
  double ab[kMaximumDegree + 1] = {};
  for (int i = 0; i <= da; ++i) {
    for (int j = 0; j <= db; ++j) ab[i + j] += a[i] * b[j];
  }
  for (int i = 0; i <= da + db; ++i) {
    for (int j = 0; j <= dc; ++j) sum[i + j] += sign * ab[i] * c[j];
  }
}

/// Three equations in x and y with z as hidden variable: p x + q y + r = 0 with p, q of degree 3
/// and r of degree 4 in z.
struct Hidden {
  InZ row[3][3] = {};
};

/// Subtracts z times one row from another, so that x and y occur linearly.
Hidden hide_z(const Eigen::Matrix<double, 10, 10>& reduced) {
  Hidden hidden;
  for (int k = 0; k < 3; ++k) {
    // One monomial times z, and the monomial itself.
    const auto with_z = reduced.row(4 + 2 * k), without = reduced.row(5 + 2 * k);
    for (int part = 0; part < 2; ++part) {
      InZ& p = hidden.row[k][part];
      const int at = 3 * part;
      p[3] = -without[at];
      p[2] = with_z[at] - without[at + 1];
      p[1] = with_z[at + 1] - without[at + 2];
      p[0] = with_z[at + 2];
    }
    InZ& r = hidden.row[k][2];
    r[4] = -without[6];
    for (int i = 0; i < 3; ++i) r[3 - i] = with_z[6 + i] - without[7 + i];
    r[0] = with_z[9];
  }
  return hidden;
}

/// The determinant of the equations, a polynomial of degree 10 in z.
InZ determinant(const Hidden& h) {
  InZ sum = {};
  constexpr int kEven[3][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}};
  for (const auto& p : kEven) {
    add_product(sum, 1, h.row[p[0]][0], 3, h.row[p[1]][1], 3, h.row[p[2]][2], 4);
    add_product(sum, -1, h.row[p[1]][0], 3, h.row[p[0]][1], 3, h.row[p[2]][2], 4);
  }
  return sum;
}

/// x and y of the solution for this z: the null vector of the best conditioned two equations.
Eigen::Vector3d solve_at(const Hidden& h, double z) {
  Eigen::Matrix3d m;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int i = 4; i >= 0; --i) sum = sum * z + h.row[r][c][i];
      m(r, c) = sum;
    }
    const double norm = m.row(r).norm();
    if (norm > 0) m.row(r) /= norm;
  }
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (int r = 0; r < 3; ++r) {
    const Eigen::Vector3d candidate = m.row(r).cross(m.row((r + 1) % 3));
    if (candidate.squaredNorm() > best.squaredNorm()) best = candidate;
  }
  return best;
}

}  // namespace

void five_point(const Eigen::Vector2d* first, const Eigen::Vector2d* second, Matrix3List& result) {
  result.clear();
  const Basis basis = null_space(first, second);
  const Eigen::Matrix<double, 10, 20> rows = constraints(basis);
  const Eigen::Matrix<double, 10, 10> reduced =
      rows.leftCols<10>().partialPivLu().solve(rows.rightCols<10>());
  if (!reduced.allFinite()) return;
  const Hidden hidden = hide_z(reduced);
  const InZ polynomial = determinant(hidden);
  const RealRoots roots = real_roots(polynomial.data(), 10);
  for (int i = 0; i < roots.count; ++i) {
    const double z = roots.values[i];
    const Eigen::Vector3d xy = solve_at(hidden, z);
    if (!(std::abs(xy[2]) > 0)) continue;
    const Eigen::Vector4d weights(xy[0] / xy[2], xy[1] / xy[2], z, 1);
    const Eigen::Matrix<double, 9, 1> e = (basis * weights).normalized();
    if (!e.allFinite()) continue;
    result.push_back(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(e.data()));
  }
}

}  // namespace ck
