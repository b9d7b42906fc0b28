#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/quadric.h"

namespace ck::mesh {

/// A mesh with vertex–triangle incidence. The corners (3 · triangle + 0…2) at a vertex form a ring
/// (circular list), so that two vertices can be merged without allocation.
///
/// Threads may change parts of a mesh that have no vertex in common. Searches mark vertices with
/// numbers that they count up in a `Marks`; a thread needs one of its own.
class CollapseMesh {
 public:
  using Face = std::array<uint32_t, 3>;
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  /// The last number that marked a vertex.
  using Marks = uint32_t;

  /// No triangle may use a vertex twice.
  CollapseMesh(std::vector<Point> points, std::vector<Face> faces)
      : points_(std::move(points)),
        faces_(std::move(faces)),
        next_(3 * faces_.size()),
        first_(points_.size(), kNone),
        marks_(points_.size(), 0) {
    for (uint32_t corner = 0; corner < next_.size(); ++corner) {
      uint32_t& first = first_[faces_[corner / 3][corner % 3]];
      if (first == kNone) {
        first = next_[corner] = corner;
      } else {
        next_[corner] = std::exchange(next_[first], corner);
      }
    }
  }

  size_t vertex_count() const { return points_.size(); }
  const Point& point(uint32_t v) const { return points_[v]; }
  void move(uint32_t v, const Point& p) { points_[v] = p; }
  /// Whether a triangle uses `v`.
  bool is_used(uint32_t v) const { return first_[v] != kNone; }

  /// Number of triangles, including removed ones.
  size_t face_count() const { return faces_.size(); }
  const Face& face(size_t f) const { return faces_[f]; }
  bool is_alive(size_t f) const { return faces_[f][0] != kNone; }

  bool has(uint32_t face, uint32_t vertex) const {
    const Face& f = faces_[face];
    return f[0] == vertex || f[1] == vertex || f[2] == vertex;
  }

  /// The normal of a triangle, with twice its area as length.
  Point normal(const Face& f) const { return normal(points_[f[0]], points_[f[1]], points_[f[2]]); }

  /// The same with vertex `v` moved to `p`.
  Point normal(const Face& f, uint32_t v, const Point& p) const {
    return normal(f[0] == v ? p : points_[f[0]], f[1] == v ? p : points_[f[1]],
                  f[2] == v ? p : points_[f[2]]);
  }

  /// Calls `body(face)` for the triangles of `v` until it returns false; returns whether it never
  /// did.
  template <typename Body>
  bool all_faces(uint32_t v, Body&& body) const {
    const uint32_t first = first_[v];
    if (first == kNone) return true;
    uint32_t corner = first;
    do {
      if (!body(corner / 3)) return false;
      corner = next_[corner];
    } while (corner != first);
    return true;
  }

  template <typename Body>
  void for_faces(uint32_t v, Body&& body) const {
    all_faces(v, [&](uint32_t f) {
      body(f);
      return true;
    });
  }

  /// Calls `body(vertex)` once for each neighbor of `v`; returns the number of its triangles.
  template <typename Body>
  size_t for_neighbors(uint32_t v, Marks& marks, Body&& body) {
    const uint32_t mark = ++marks;
    size_t count = 0;
    for_faces(v, [&](uint32_t f) {
      ++count;
      for (const uint32_t w : faces_[f]) {
        if (w != v && std::exchange(marks_[w], mark) != mark) body(w);
      }
    });
    return count;
  }

  size_t shared_faces(uint32_t a, uint32_t b) const {
    size_t count = 0;
    for_faces(a, [&](uint32_t f) { count += has(f, b); });
    return count;
  }

  /// Whether `v` is on the boundary: its triangles do not form a closed fan.
  bool is_border(uint32_t v, Marks& marks) {
    size_t around = 0;
    return for_neighbors(v, marks, [&](uint32_t) { ++around; }) != around;
  }

  /// Whether merging `a` and `b` preserves the manifold (link condition): their common neighbors
  /// are those of the shared triangles, and two boundaries do not meet.
  bool can_join(uint32_t a, uint32_t b, Marks& marks) {
    size_t around_a = 0, around_b = 0, common = 0;
    const size_t faces_a = for_neighbors(a, marks, [&](uint32_t) { ++around_a; });
    const uint32_t mark_a = marks, mark_b = ++marks;
    size_t faces_b = 0, shared = 0;
    for_faces(b, [&](uint32_t f) {
      ++faces_b;
      shared += has(f, a);
      for (const uint32_t w : faces_[f]) {
        if (w == b || marks_[w] == mark_b) continue;
        common += marks_[w] == mark_a;
        marks_[w] = mark_b;
        ++around_b;
      }
    });
    if (shared == 0 || shared > 2 || common != shared) return false;
    // A tetrahedron is the smallest closed surface.
    if (around_a + around_b - common - 2 < 3) return false;
    return shared != 2 || around_a == faces_a || around_b == faces_b;
  }

  /// Merges `gone` into `kept`; requires `can_join`. Returns the number of triangles removed.
  size_t join(uint32_t kept, uint32_t gone) {
    std::array<uint32_t, 2> dead;
    size_t count = 0;
    for_faces(gone, [&](uint32_t f) {
      if (has(f, kept)) {
        dead[count++] = f;
        return;
      }
      for (uint32_t& v : faces_[f]) {
        if (v == gone) v = kept;
      }
    });
    for (size_t i = 0; i < count; ++i) remove(dead[i]);
    if (first_[gone] == kNone) return count;
    if (first_[kept] == kNone) {
      first_[kept] = first_[gone];
    } else {
      std::swap(next_[first_[kept]], next_[first_[gone]]);
    }
    first_[gone] = kNone;
    return count;
  }

  /// Removes a triangle.
  void remove(uint32_t face) {
    for (const uint32_t v : faces_[face]) {
      uint32_t before = first_[v];
      while (next_[before] / 3 != face) before = next_[before];
      const uint32_t corner = next_[before];
      next_[before] = next_[corner];
      first_[v] = before == corner ? kNone : before;
    }
    faces_[face][0] = kNone;
  }

 private:
  static Point normal(const Point& a, const Point& b, const Point& c) {
    return cross(b - a, c - a);
  }

  std::vector<Point> points_;
  std::vector<Face> faces_;
  std::vector<uint32_t> next_, first_, marks_;
};

}  // namespace ck::mesh
