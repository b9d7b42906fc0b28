#pragma once

#include <array>
#include <cmath>

namespace ck::mesh {

/// A point or vector.
using Point = std::array<double, 3>;

inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator*(const Point& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The weighted sum of squared distances to planes, as a quadratic form in the point.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  Point linear = {0, 0, 0};
  double constant = 0;

  /// Adds the plane through `p` with unit normal `n`.
  void add_plane(const Point& n, const Point& p, double weight) {
    const double d = dot(n, p);
    add_direction(n, weight, weight * d);
    constant += weight * d * d;
  }

  /// Adds planes with a common unit normal `n`, given the sum of their weights and the weighted sum
  /// of their distances from the origin; does not update the constant.
  void add_direction(const Point& n, double weight, double distance) {
    xx += weight * n[0] * n[0];
    xy += weight * n[0] * n[1];
    xz += weight * n[0] * n[2];
    yy += weight * n[1] * n[1];
    yz += weight * n[1] * n[2];
    zz += weight * n[2] * n[2];
    linear = linear - n * distance;
  }

  Quadric& operator+=(const Quadric& o) {
    xx += o.xx;
    xy += o.xy;
    xz += o.xz;
    yy += o.yy;
    yz += o.yz;
    zz += o.zz;
    linear = linear + o.linear;
    constant += o.constant;
    return *this;
  }

  /// The value at a point.
  double operator()(const Point& p) const {
    const double ax = xx * p[0] + xy * p[1] + xz * p[2];
    const double ay = xy * p[0] + yy * p[1] + yz * p[2];
    const double az = xz * p[0] + yz * p[1] + zz * p[2];
    return p[0] * ax + p[1] * ay + p[2] * az + 2 * dot(linear, p) + constant;
  }

  /// The point of least error, regularized toward `anchor` with a fraction of the total weight, so
  /// that it is also determined on flat surfaces.
  Point minimizer(const Point& anchor, double share) const {
    const double pull = share * (xx + yy + zz) + 1e-300;
    const double a = xx + pull, d = yy + pull, f = zz + pull;
    const Point r = anchor * pull - linear;
    const double c00 = d * f - yz * yz, c01 = xz * yz - xy * f, c02 = xy * yz - xz * d;
    const double determinant = a * c00 + xy * c01 + xz * c02;
    if (!(std::fabs(determinant) > 1e-300)) return anchor;
    const double c11 = a * f - xz * xz, c12 = xy * xz - a * yz, c22 = a * d - xy * xy;
    const Point p = {(c00 * r[0] + c01 * r[1] + c02 * r[2]) / determinant,
                     (c01 * r[0] + c11 * r[1] + c12 * r[2]) / determinant,
                     (c02 * r[0] + c12 * r[1] + c22 * r[2]) / determinant};
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]) ? p : anchor;
  }
};

}  // namespace ck::mesh
