#include "resection/p3p.h"

#include <Eigen/Eigenvalues>

#include "ck_resection.h"
#include "core/guard.h"

namespace ck {
namespace {

using Matrix3 = Eigen::Matrix3d;

/// Largest number of steps to a root. Limit: about as many bisections exhaust double precision.
constexpr int kRootSteps = 100;
/// Largest number of Gauss–Newton steps on a solution. Chosen: they converge quadratically.
constexpr int kPolishSteps = 5;

/// A real root of c3 x³ + c2 x² + c1 x + c0 by Newton's method within a bracket.
double real_cubic_root(double c3, double c2, double c1, double c0) {
  const double a = c2 / c3, b = c1 / c3, c = c0 / c3;
  // Cauchy's bound encloses all roots; on each side of the inflection point there is at least one.
  const double bound = 1 + std::max({std::abs(a), std::abs(b), std::abs(c)});
  const double inflection = -a / 3;
  const double value = ((inflection + a) * inflection + b) * inflection + c;
  double low = value > 0 ? -bound : inflection;
  double high = value > 0 ? inflection : bound;
  double x = 0.5 * (low + high);
  for (int i = 0; i < kRootSteps; ++i) {
    const double f = ((x + a) * x + b) * x + c;
    if (f == 0) break;
    (f > 0 ? high : low) = x;
    const double slope = (3 * x + 2 * a) * x + b;
    double next = slope != 0 ? x - f / slope : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-16 * std::abs(x)) break;
    x = next;
  }
  return x;
}

/// The matrices of Λᵀ M Λ = |Pi − Pj|² for the three pairs of rays, and the squared distances.
struct Constraints {
  std::array<Matrix3, 3> matrices;
  Vector3 squares;

  Constraints(const std::array<Vector3, 3>& rays, const std::array<Vector3, 3>& points) {
    for (int k = 0; k < 3; ++k) {
      const int i = k == 2 ? 1 : 0, j = k == 0 ? 1 : 2;
      matrices[k].setZero();
      matrices[k](i, i) = matrices[k](j, j) = 1;
      matrices[k](i, j) = matrices[k](j, i) = -rays[i].dot(rays[j]);
      squares[k] = (points[i] - points[j]).squaredNorm();
    }
  }

  Vector3 residual(const Vector3& depths) const {
    Vector3 r;
    for (int k = 0; k < 3; ++k) r[k] = depths.dot(matrices[k] * depths) - squares[k];
    return r;
  }
};

/// Gauss–Newton on the three distance equations.
void polish(const Constraints& constraints, Vector3& depths) {
  Vector3 r = constraints.residual(depths);
  for (int i = 0; i < kPolishSteps; ++i) {
    Matrix3 j;
    for (int k = 0; k < 3; ++k) j.row(k) = 2 * (constraints.matrices[k] * depths).transpose();
    if (!(std::abs(j.determinant()) > 0)) return;
    const Vector3 candidate = depths - j.inverse() * r;
    const Vector3 next = constraints.residual(candidate);
    if (!(next.squaredNorm() < r.squaredNorm())) return;
    depths = candidate;
    r = next;
  }
}

/// The depths on the plane w · Λ = 0 that satisfy the homogeneous `conic` and the sum of the
/// constraints.
int depths_on_plane(const Vector3& w, const Matrix3& conic, const Constraints& constraints,
                    std::array<Vector3, 4>& depths, int count) {
  if (!(w.norm() > 0)) return count;
  const Vector3 u = w.unitOrthogonal();
  const Vector3 v = w.cross(u).normalized();
  const double a = u.dot(conic * u), b = u.dot(conic * v), c = v.dot(conic * v);
  const double discriminant = b * b - a * c;
  const double scale = std::max({std::abs(a), std::abs(b), std::abs(c)});
  if (!(scale > 0) || discriminant < -1e-12 * scale * scale) return count;
  const double root = std::sqrt(std::max(0.0, discriminant));
  const double q = -(b + (b < 0 ? -root : root));
  // Roots of a α² + 2 b α β + c β² as (α : β); numerically stable if any of the coefficients is
  // near zero.
  const Vector2 roots[2] = {{q, a}, {c, q}};
  const Matrix3 sum = constraints.matrices[0] + constraints.matrices[1] + constraints.matrices[2];
  for (const Vector2& ratio : roots) {
    Vector3 direction = ratio.x() * u + ratio.y() * v;
    const double length = direction.norm();
    if (!(length > 0)) continue;
    direction /= length;
    if (direction.sum() < 0) direction = -direction;
    if (!(direction.minCoeff() > 0) || count >= 4) continue;
    const double square = direction.dot(sum * direction);
    if (!(square > 0)) continue;
    depths[count++] = std::sqrt(constraints.squares.sum() / square) * direction;
  }
  return count;
}

/// The pose that moves the three points onto the rays at the given depths.
bool pose_of(const std::array<Vector3, 3>& rays, const std::array<Vector3, 3>& points,
             const Vector3& depths, Pose& pose) {
  Matrix3 source, target;
  const Vector3 p0 = depths[0] * rays[0];
  source.col(0) = points[1] - points[0];
  source.col(1) = points[2] - points[0];
  source.col(2) = source.col(0).cross(source.col(1));
  target.col(0) = depths[1] * rays[1] - p0;
  target.col(1) = depths[2] * rays[2] - p0;
  target.col(2) = target.col(0).cross(target.col(1));
  const Matrix3 rotation = target * source.inverse();
  pose.rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  pose.translation = p0 - pose.rotation * points[0];
  return pose.rotation.allFinite() && pose.translation.allFinite();
}

/// A degenerate conic D0 of the pencil spanned by the distance equations, and another conic of the
/// pencil.
bool degenerate_conic(const Constraints& constraints, Matrix3& degenerate, Matrix3& other) {
  const auto& [m12, m13, m23] = constraints.matrices;
  const Vector3 a = constraints.squares / constraints.squares.maxCoeff();
  const Matrix3 d1 = m12 * a[2] - m23 * a[0];
  const Matrix3 d2 = m13 * a[2] - m23 * a[1];
  // det(d1 + γ d2) as a polynomial in γ; at its root the conic degenerates into two planes.
  auto mixed = [](const Matrix3& x, const Matrix3& y, const Matrix3& z) {
    return x.col(0).dot(y.col(1).cross(z.col(2)));
  };
  const double c0 = d1.determinant(), c3 = d2.determinant();
  const double c1 = mixed(d2, d1, d1) + mixed(d1, d2, d1) + mixed(d1, d1, d2);
  const double c2 = mixed(d1, d2, d2) + mixed(d2, d1, d2) + mixed(d2, d2, d1);
  const double largest = std::max({std::abs(c0), std::abs(c1), std::abs(c2), std::abs(c3)});
  // Swap d1 and d2 if that makes the cubic better conditioned.
  const bool swap = std::abs(c3) < std::abs(c0);
  if (!(std::abs(swap ? c0 : c3) > 1e-14 * largest)) return false;
  const double gamma = swap ? real_cubic_root(c0, c1, c2, c3) : real_cubic_root(c3, c2, c1, c0);
  degenerate = swap ? Matrix3(d2 + gamma * d1) : Matrix3(d1 + gamma * d2);
  other = swap ? d1 : d2;
  return degenerate.allFinite();
}

}  // namespace

int p3p(const std::array<Vector3, 3>& rays, const std::array<Vector3, 3>& points,
        std::array<Pose, 4>& poses) {
  const Vector3 area = (points[1] - points[0]).cross(points[2] - points[0]);
  const Constraints constraints(rays, points);
  const double extent = constraints.squares.maxCoeff();
  if (!(area.squaredNorm() > 1e-18 * extent * extent)) return 0;
  Matrix3 degenerate, other;
  if (!degenerate_conic(constraints, degenerate, other)) return 0;

  // The eigenvalue nearest to zero belongs to the degenerate direction; the others need opposite
  // signs.
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(degenerate);
  if (eigen.info() != Eigen::Success) return 0;
  const double low = eigen.eigenvalues()[0], high = eigen.eigenvalues()[2];
  if (!(low <= 0 && high >= 0 && high > low)) return 0;
  const Vector3 e1 = std::sqrt(high) * eigen.eigenvectors().col(2);
  const Vector3 e2 = std::sqrt(-low) * eigen.eigenvectors().col(0);
  std::array<Vector3, 4> depths;
  int count = depths_on_plane(e1 + e2, other, constraints, depths, 0);
  count = depths_on_plane(e1 - e2, other, constraints, depths, count);
  int found = 0;
  for (int i = 0; i < count; ++i) {
    polish(constraints, depths[i]);
    if (depths[i].minCoeff() > 0 && pose_of(rays, points, depths[i], poses[found])) ++found;
  }
  return found;
}

}  // namespace ck

ck_status ck_p3p(const double* rays, const double* points, ck_pose* poses, size_t* pose_count) {
  return ck::guarded([&] {
    ck::require(poses && pose_count && rays && points, "p3p needs rays and points");
    std::array<ck::Vector3, 3> r, p;
    for (int i = 0; i < 3; ++i) {
      r[i] = ck::Vector3(rays[3 * i], rays[3 * i + 1], rays[3 * i + 2]).normalized();
      p[i] = ck::Vector3(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      ck::require(r[i].allFinite() && p[i].allFinite(), "p3p needs finite rays and points");
    }
    std::array<ck::Pose, 4> found;
    const int count = ck::p3p(r, p, found);
    for (int i = 0; i < count; ++i) poses[i] = ck::pose_to(found[i]);
    *pose_count = static_cast<size_t>(count);
  });
}
