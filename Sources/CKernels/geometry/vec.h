#pragma once

#include <cmath>
#include <cstddef>

#include "core/span.h"

namespace ck {

/// Three floats with vector arithmetic.
struct Vec3 {
  float x = 0, y = 0, z = 0;

  Vec3 operator+(Vec3 o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec3 operator-(Vec3 o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec3 operator-() const { return {-x, -y, -z}; }
  Vec3 operator*(float s) const { return {x * s, y * s, z * s}; }
  Vec3& operator+=(Vec3 o) { return *this = *this + o; }
};

/// Dot product.
inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// Cross product.
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Euclidean norm.
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }

/// Scales to unit length; the zero vector stays zero.
inline Vec3 normalized(Vec3 a) {
  const float l = length(a);
  return l > 0 ? a * (1 / l) : a;
}

/// Element `index` of a span of vectors (3 floats each).
inline Vec3 vec_at(const ck_span& span, size_t index) {
  const float* p = Strided<float>(span)[index];
  return {p[0], p[1], p[2]};
}

/// Two floats with vector arithmetic.
struct Vec2 {
  float x = 0, y = 0;

  Vec2 operator+(Vec2 o) const { return {x + o.x, y + o.y}; }
  Vec2 operator-(Vec2 o) const { return {x - o.x, y - o.y}; }
  Vec2 operator*(float s) const { return {x * s, y * s}; }
};

/// The z component of the cross product: twice the signed area of the triangle (0, a, b).
inline float cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Two unit vectors that form a right-handed orthonormal frame with the unit vector `n` as third.
inline void frame_around(Vec3 n, Vec3* u, Vec3* v) {
  const Vec3 helper = std::fabs(n.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  *u = normalized(cross(helper, n));
  *v = cross(n, *u);
}

}  // namespace ck
