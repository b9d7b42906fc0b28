#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <queue>
#include <vector>

#include "ck_texture.h"
#include "core/guard.h"
#include "texture/quadric.h"
#include "texture/vec.h"

namespace ck::texture {
namespace {

using Face = std::array<uint32_t, 3>;

struct Collapse {
  float cost;
  uint32_t a, b;
  uint32_t version;
  bool operator<(const Collapse& o) const {
    if (cost != o.cost) return cost > o.cost;
    return a != o.a ? a > o.a : b > o.b;
  }
};

struct Vertex {
  Point position;
  Quadric quadric;
  std::vector<uint32_t> faces;
  uint32_t version = 0;
};

class Simplifier {
 public:
  Simplifier(const float* positions, size_t position_count, size_t stride,
             const uint32_t* triangles, size_t triangle_count)
      : vertices_(position_count) {
    for (size_t i = 0; i < position_count; ++i) {
      const Vec3 p = vec_at(positions, stride, i);
      require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
              "a mesh has a vertex that is not finite");
      vertices_[i].position = {p.x, p.y, p.z};
    }
    load_faces(triangles, triangle_count);
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      for (const uint32_t v : faces_[f]) vertices_[v].faces.push_back(f);
    }
    add_quadrics();
  }

  /// Collapses the cheapest edges first; no triangle may turn by more than the angle of `cosine`.
  void run(size_t maximum, double cosine, const ck_control* control) {
    if (alive_ <= maximum) return;
    minimum_cosine_ = cosine;
    fill_queue();
    const size_t start = alive_;
    size_t count = 0;
    while (alive_ > maximum && !queue_.empty()) {
      const Collapse c = queue_.top();
      queue_.pop();
      if (++count % 8192 == 0) {
        step(control, static_cast<double>(start - alive_) / static_cast<double>(start - maximum));
      }
      Vertex &a = vertices_[c.a], &b = vertices_[c.b];
      if (a.version + b.version != c.version || a.faces.empty() || b.faces.empty()) continue;
      collapse(c.a, c.b);
    }
  }

  /// Drops the smallest components until no more than `maximum` triangles and `maximum_pieces`
  /// components are left.
  void drop_components(size_t maximum, size_t maximum_pieces) {
    std::vector<uint32_t> parents(vertices_.size());
    std::iota(parents.begin(), parents.end(), 0u);
    const auto root = [&](uint32_t i) {
      while (parents[i] != i) i = parents[i] = parents[parents[i]];
      return i;
    };
    for (const Face& f : faces_) {
      for (size_t k = 1; f[0] != kNone && k < 3; ++k) {
        const uint32_t a = root(f[0]), b = root(f[k]);
        parents[std::max(a, b)] = std::min(a, b);
      }
    }
    std::vector<double> areas(vertices_.size(), 0);
    std::vector<size_t> counts(vertices_.size(), 0);
    for (const Face& f : faces_) {
      if (f[0] == kNone) continue;
      areas[root(f[0])] += std::sqrt(dot(normal(f), normal(f)));
      ++counts[root(f[0])];
    }
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < counts.size(); ++i) {
      if (counts[i] > 0) order.push_back(i);
    }
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return areas[a] != areas[b] ? areas[a] < areas[b] : a < b;
    });
    std::vector<bool> is_dropped(vertices_.size(), false);
    for (size_t k = 0; k + 1 < order.size(); ++k) {
      if (alive_ <= maximum && order.size() - k <= maximum_pieces) break;
      is_dropped[order[k]] = true;
      alive_ -= counts[order[k]];
    }
    for (Face& f : faces_) {
      if (f[0] == kNone || !is_dropped[root(f[0])]) continue;
      for (const uint32_t v : f) vertices_[v].faces.clear();
      f[0] = kNone;
    }
  }

  void copy(float* positions, size_t* position_count, size_t stride, uint32_t* triangles,
            size_t* triangle_count) const {
    std::vector<uint32_t> ids(vertices_.size(), kNone);
    uint32_t vertex_count = 0;
    size_t count = 0;
    for (const Face& f : faces_) {
      if (f[0] == kNone) continue;
      for (const uint32_t v : f) {
        if (ids[v] == kNone) ids[v] = 0;
      }
    }
    for (size_t v = 0; v < ids.size(); ++v) {
      if (ids[v] == kNone) continue;
      ids[v] = vertex_count++;
      auto* p = reinterpret_cast<float*>(reinterpret_cast<char*>(positions) + stride * ids[v]);
      for (size_t k = 0; k < 3; ++k) p[k] = static_cast<float>(vertices_[v].position[k]);
    }
    for (const Face& f : faces_) {
      if (f[0] == kNone) continue;
      for (size_t k = 0; k < 3; ++k) triangles[3 * count + k] = ids[f[k]];
      ++count;
    }
    *position_count = vertex_count;
    *triangle_count = count;
  }

 private:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

  void load_faces(const uint32_t* triangles, size_t count) {
    std::vector<std::pair<Face, size_t>> sorted;
    sorted.reserve(count);
    for (size_t t = 0; t < count; ++t) {
      Face f = {triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]};
      for (const uint32_t v : f) {
        require(v < vertices_.size(), "a triangle names a vertex that isn't there");
      }
      if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
      std::sort(f.begin(), f.end());
      sorted.push_back({f, t});
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<size_t> kept;
    for (size_t i = 0; i < sorted.size(); ++i) {
      if (i == 0 || sorted[i].first != sorted[i - 1].first) kept.push_back(sorted[i].second);
    }
    std::sort(kept.begin(), kept.end());
    for (const size_t t : kept) {
      faces_.push_back({triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]});
    }
    alive_ = faces_.size();
  }

  Point normal(const Face& f) const {
    const Point& a = vertices_[f[0]].position;
    return cross(vertices_[f[1]].position - a, vertices_[f[2]].position - a);
  }

  void add_quadrics() {
    for (const Face& f : faces_) {
      const Point n = normal(f);
      const double doubled = std::sqrt(dot(n, n));
      if (!(doubled > 0)) continue;
      Quadric q;
      q.add_plane(n * (1 / doubled), vertices_[f[0]].position, doubled / 6);
      for (size_t k = 0; k < 3; ++k) {
        vertices_[f[k]].quadric += q;
        add_border(f[k], f[(k + 1) % 3], n * (1 / doubled));
      }
    }
  }

  /// An upright plane along an edge that only one triangle has holds the outline in its place.
  void add_border(uint32_t a, uint32_t b, const Point& n) {
    if (shared_faces(a, b) != 1) return;
    const Point along = vertices_[b].position - vertices_[a].position;
    const Point side = cross(along, n);
    const double length2 = dot(side, side);
    if (!(length2 > 0)) return;
    Quadric q;
    q.add_plane(side * (1 / std::sqrt(length2)), vertices_[a].position, length2);
    vertices_[a].quadric += q;
    vertices_[b].quadric += q;
  }

  bool has(uint32_t face, uint32_t vertex) const {
    const Face& f = faces_[face];
    return f[0] == vertex || f[1] == vertex || f[2] == vertex;
  }

  size_t shared_faces(uint32_t a, uint32_t b) const {
    const auto& list = vertices_[a].faces;
    return static_cast<size_t>(
        std::count_if(list.begin(), list.end(), [&](uint32_t f) { return has(f, b); }));
  }

  void neighbors(uint32_t v, std::vector<uint32_t>* out) const {
    out->clear();
    for (const uint32_t f : vertices_[v].faces) {
      for (const uint32_t w : faces_[f]) {
        if (w != v) out->push_back(w);
      }
    }
    std::sort(out->begin(), out->end());
    out->erase(std::unique(out->begin(), out->end()), out->end());
  }

  Point target(uint32_t a, uint32_t b, Quadric* q) const {
    *q = vertices_[a].quadric;
    *q += vertices_[b].quadric;
    return q->minimizer((vertices_[a].position + vertices_[b].position) * 0.5);
  }

  void push(uint32_t first, uint32_t second) {
    const uint32_t a = std::min(first, second), b = std::max(first, second);
    Quadric q;
    const Point p = target(a, b, &q);
    const Point along = vertices_[a].position - vertices_[b].position;
    // Among edges without error the shortest go first.
    const double cost = std::max(0.0, q(p)) + 1e-9 * dot(along, along) * dot(along, along);
    queue_.push({static_cast<float>(cost), a, b, vertices_[a].version + vertices_[b].version});
  }

  void fill_queue() {
    queue_ = {};
    for (const Face& f : faces_) {
      if (f[0] == kNone) continue;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = f[k], b = f[(k + 1) % 3];
        if (a < b || shared_faces(a, b) == 1) push(a, b);
      }
    }
  }

  /// Whether the surface stays a surface: the vertices next to both ends are those of the shared
  /// triangles, and no two borders meet.
  bool keeps_topology(uint32_t a, uint32_t b) {
    neighbors(a, &around_a_);
    neighbors(b, &around_b_);
    std::vector<uint32_t>& common = common_;
    common.clear();
    std::set_intersection(around_a_.begin(), around_a_.end(), around_b_.begin(), around_b_.end(),
                          std::back_inserter(common));
    const size_t shared = shared_faces(a, b);
    if (shared == 0 || shared > 2 || common.size() != shared) return false;
    // A tetrahedron is the smallest closed surface.
    if (around_a_.size() + around_b_.size() - common.size() - 2 < 3) return false;
    if (shared == 2 && is_border(a, around_a_) && is_border(b, around_b_)) return false;
    return true;
  }

  bool is_border(uint32_t v, const std::vector<uint32_t>& around) const {
    return around.size() != vertices_[v].faces.size();
  }

  /// Whether the triangles that stay at `v` keep their side when it moves to `p`.
  bool keeps_shape(uint32_t v, uint32_t other, const Point& p) const {
    for (const uint32_t i : vertices_[v].faces) {
      const Face& f = faces_[i];
      if (has(i, other)) continue;
      std::array<Point, 3> moved;
      for (size_t k = 0; k < 3; ++k) moved[k] = f[k] == v ? p : vertices_[f[k]].position;
      const Point before = normal(f);
      const Point after = cross(moved[1] - moved[0], moved[2] - moved[0]);
      const double before2 = dot(before, before), after2 = dot(after, after);
      if (!(after2 > 0)) return false;
      if (before2 > 0 && dot(before, after) < minimum_cosine_ * std::sqrt(before2 * after2)) {
        return false;
      }
    }
    return true;
  }

  void collapse(uint32_t a, uint32_t b) {
    if (!keeps_topology(a, b)) return;
    Quadric q;
    Point p = target(a, b, &q);
    if (!keeps_shape(a, b, p) || !keeps_shape(b, a, p)) {
      p = (vertices_[a].position + vertices_[b].position) * 0.5;
      if (!keeps_shape(a, b, p) || !keeps_shape(b, a, p)) return;
    }
    Vertex &kept = vertices_[a], &gone = vertices_[b];
    kept.position = p;
    kept.quadric = q;
    std::vector<uint32_t> faces;
    for (const uint32_t f : kept.faces) {
      if (!has(f, b)) {
        faces.push_back(f);
        continue;
      }
      for (const uint32_t v : faces_[f]) {
        if (v != a && v != b) erase(&vertices_[v].faces, f);
      }
      --alive_;
    }
    for (const uint32_t f : gone.faces) {
      if (has(f, a)) {
        faces_[f][0] = kNone;
        continue;
      }
      for (uint32_t& v : faces_[f]) {
        if (v == b) v = a;
      }
      faces.push_back(f);
    }
    kept.faces = std::move(faces);
    gone.faces = {};
    kept.version += gone.version + 1;
    neighbors(a, &around_a_);
    for (const uint32_t v : around_a_) push(a, v);
  }

  static void erase(std::vector<uint32_t>* list, uint32_t value) {
    list->erase(std::remove(list->begin(), list->end(), value), list->end());
  }

  std::vector<Vertex> vertices_;
  std::vector<Face> faces_;
  std::priority_queue<Collapse> queue_;
  std::vector<uint32_t> around_a_, around_b_, common_;
  size_t alive_ = 0;
  double minimum_cosine_ = 0;
};

}  // namespace
}  // namespace ck::texture

ck_status ck_simplify(float* positions, size_t* position_count, size_t position_stride,
                      uint32_t* triangles, size_t* triangle_count, size_t maximum_count,
                      const ck_control* control) {
  return ck::guarded([&] {
    ck::require(positions && position_count && triangles && triangle_count,
                "an argument is missing");
    ck::step(control, 0);
    ck::texture::Simplifier simplifier(positions, *position_count, position_stride, triangles,
                                       *triangle_count);
    // No closed piece has fewer than four triangles: many crumbs would take the budget.
    simplifier.drop_components(*triangle_count, std::max<size_t>(1, maximum_count / 16));
    // What is refused in one pass may be allowed after its surroundings have changed. A limit on
    // the triangles' shape does harm: it stops what would mend the slivers of the input.
    for (const double cosine : {0.2, 0.2, 0.0}) simplifier.run(maximum_count, cosine, control);
    simplifier.drop_components(maximum_count, maximum_count);
    simplifier.copy(positions, position_count, position_stride, triangles, triangle_count);
  });
}
