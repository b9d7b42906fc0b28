#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "ck_mesh.h"
#include "core/disjoint_sets.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "mesh/collapse_mesh.h"
#include "mesh/collapse_queue.h"
#include "mesh/quadric.h"
#include "mesh/surface_fit.h"

namespace ck::mesh {
namespace {

using Face = CollapseMesh::Face;

/// A new vertex is regularized toward the midpoint of its edge with this fraction of the weight of
/// its planes, and is at most `kReach` edge lengths from it: nearly parallel planes intersect far
/// away.
constexpr double kPull = 1e-4, kReach = 2;
/// Cosine of the largest angle by which a collapse may rotate a triangle's normal, in each of the
/// passes; the last one permits collapses that the others rejected. Empirical.
constexpr double kTurnCosines[] = {0.2, 0.2, 0.0};
/// Weight of the fourth power of an edge's length in its cost: among edges without error the
/// shortest are collapsed first.
constexpr double kLengthWeight = 1e-9;
/// The number of components is limited to one per this number of triangles of the result.
/// Empirical.
constexpr size_t kTrianglesPerPiece = 16;
/// Number of edges that a thread works on at a time. Chosen: about a millisecond.
constexpr size_t kBlock = 8192;

/// The vertices; throws if one is not finite.
std::vector<Point> load_points(const InputMesh& input) {
  std::vector<Point> points(input.positions.count);
  for (size_t i = 0; i < points.size(); ++i) {
    points[i] = input.point(i);
    require(
        std::isfinite(points[i][0]) && std::isfinite(points[i][1]) && std::isfinite(points[i][2]),
        "a mesh vertex is not finite");
  }
  return points;
}

/// The triangles, except those that use a vertex twice or have the same vertices as an earlier one.
std::vector<Face> load_faces(const InputMesh& input) {
  std::vector<std::pair<Face, size_t>> sorted;
  sorted.reserve(input.triangle_count);
  for (size_t t = 0; t < input.triangle_count; ++t) {
    const uint32_t* corners = input.triangles + 3 * t;
    Face f = {corners[0], corners[1], corners[2]};
    for (const uint32_t v : f) {
      require(v < input.positions.count, "a triangle refers to a vertex that does not exist");
    }
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    std::sort(f.begin(), f.end());
    sorted.push_back({f, t});
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> is_kept(input.triangle_count, false);
  for (size_t i = 0; i < sorted.size(); ++i) {
    is_kept[sorted[i].second] = i == 0 || sorted[i].first != sorted[i - 1].first;
  }
  std::vector<Face> faces;
  faces.reserve(sorted.size());
  for (size_t t = 0; t < is_kept.size(); ++t) {
    const uint32_t* corners = input.triangles + 3 * t;
    if (is_kept[t]) faces.push_back({corners[0], corners[1], corners[2]});
  }
  return faces;
}

/// Quadric edge collapse with component removal and a final fit.
class Simplifier {
 public:
  explicit Simplifier(const InputMesh& input)
      : input_(input),
        mesh_(load_points(input), load_faces(input)),
        vertices_(input.positions.count),
        versions_(input.positions.count, 0),
        representatives_(input.positions.count),
        alive_(mesh_.face_count()) {
    find_borders();
    add_quadrics();
  }

  /// Collapses the cheapest edges first; a triangle's normal may not rotate by more than the angle
  /// of `cosine`.
  void run(size_t maximum, double cosine, const ck_control* control) {
    if (alive_ <= maximum) return;
    minimum_cosine_ = cosine;
    fill_queue(control);
    const size_t start = alive_;
    size_t count = 0;
    Collapse c;
    while (alive_ > maximum && queue_.pop(&c)) {
      if (++count % 8192 == 0) {
        step(control, static_cast<double>(start - alive_) / static_cast<double>(start - maximum));
      }
      if (versions_[c.a] + versions_[c.b] == c.version) collapse(c);
    }
  }

  /// Removes the smallest components until at most `maximum` triangles and `maximum_pieces`
  /// components are left.
  void drop_components(size_t maximum, size_t maximum_pieces) {
    DisjointSets pieces(mesh_.vertex_count());
    for_alive([&](uint32_t i) {
      const Face& f = mesh_.face(i);
      for (size_t k = 1; k < 3; ++k) pieces.join(f[0], f[k]);
    });
    std::vector<double> areas(pieces.count(), 0);
    std::vector<size_t> counts(pieces.count(), 0);
    for_alive([&](uint32_t i) {
      const Point n = mesh_.normal(mesh_.face(i));
      const uint32_t piece = pieces.root(mesh_.face(i)[0]);
      areas[piece] += std::sqrt(dot(n, n));
      ++counts[piece];
    });
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < counts.size(); ++i) {
      if (counts[i] > 0) order.push_back(i);
    }
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return areas[a] != areas[b] ? areas[a] < areas[b] : a < b;
    });
    std::vector<bool> is_dropped(pieces.count(), false);
    for (size_t k = 0; k + 1 < order.size(); ++k) {
      if (alive_ <= maximum && order.size() - k <= maximum_pieces) break;
      is_dropped[order[k]] = true;
      alive_ -= counts[order[k]];
    }
    for_alive([&](uint32_t i) {
      if (is_dropped[pieces.root(mesh_.face(i)[0])]) mesh_.remove(i);
    });
  }

  /// Fits the vertices to the input surface, which compensates for the shrinkage caused by the
  /// collapses.
  void fit(const ck_control* control) {
    if (!has_collapsed_) return;
    const std::vector<uint32_t> homes = representatives_.roots();
    SurfaceFit(input_, homes, &mesh_).run(control);
  }

  /// Writes the compacted mesh.
  void copy(ck_mutable_mesh* result) const {
    const MutableStrided<float> positions(result->positions);
    std::vector<uint32_t> ids(mesh_.vertex_count());
    uint32_t vertex_count = 0;
    for (uint32_t v = 0; v < ids.size(); ++v) {
      if (!mesh_.is_used(v)) continue;
      ids[v] = vertex_count++;
      float* p = positions[ids[v]];
      for (size_t k = 0; k < 3; ++k) p[k] = static_cast<float>(mesh_.point(v)[k]);
    }
    size_t count = 0;
    for_alive([&](uint32_t i) {
      for (size_t k = 0; k < 3; ++k) result->triangles[3 * count + k] = ids[mesh_.face(i)[k]];
      ++count;
    });
    result->positions.count = vertex_count;
    result->triangle_count = count;
  }

 private:
  struct Vertex {
    Quadric quadric;
    double error = 0;  ///< value of the quadric at the vertex
    bool is_border = false;
  };

  /// The vertex that replaces an edge.
  struct Target {
    Quadric quadric;
    Point position;
    double error;
  };

  template <typename Body>
  void for_alive(Body&& body) const {
    for (uint32_t i = 0; i < mesh_.face_count(); ++i) {
      if (mesh_.is_alive(i)) body(i);
    }
  }

  void find_borders() {
    for (uint32_t v = 0; v < vertices_.size(); ++v) vertices_[v].is_border = mesh_.is_border(v);
  }

  bool is_border(uint32_t a, uint32_t b) const {
    return vertices_[a].is_border && vertices_[b].is_border && mesh_.shared_faces(a, b) == 1;
  }

  void add_quadrics() {
    for_alive([&](uint32_t i) {
      const Face& f = mesh_.face(i);
      const Point n = mesh_.normal(f);
      const double doubled = std::sqrt(dot(n, n));
      if (!(doubled > 0)) return;
      Quadric q;
      q.add_plane(n * (1 / doubled), mesh_.point(f[0]), doubled / 6);
      for (size_t k = 0; k < 3; ++k) {
        vertices_[f[k]].quadric += q;
        if (is_border(f[k], f[(k + 1) % 3])) add_border(f[k], f[(k + 1) % 3], n * (1 / doubled));
      }
    });
  }

  /// A perpendicular plane along each boundary edge keeps the outline in place.
  void add_border(uint32_t a, uint32_t b, const Point& n) {
    const Point side = cross(mesh_.point(b) - mesh_.point(a), n);
    const double length2 = dot(side, side);
    if (!(length2 > 0)) return;
    Quadric q;
    q.add_plane(side * (1 / std::sqrt(length2)), mesh_.point(a), length2);
    vertices_[a].quadric += q;
    vertices_[b].quadric += q;
  }

  Target target_at(uint32_t a, uint32_t b, const Point& p) const {
    Quadric q = vertices_[a].quadric;
    q += vertices_[b].quadric;
    return {q, p, std::max(0.0, q(p))};
  }

  /// The position of least error.
  Target target(uint32_t a, uint32_t b) const {
    const Point along = mesh_.point(b) - mesh_.point(a), middle = mesh_.point(a) + along * 0.5;
    Target t = target_at(a, b, middle);
    const Point p = t.quadric.minimizer(middle, kPull), away = p - middle;
    if (dot(away, away) > kReach * kReach * dot(along, along)) return t;
    t.position = p;
    t.error = std::max(0.0, t.quadric(p));
    return t;
  }

  /// The best of the two ends and the midpoint at which no triangle rotates too far; false if there
  /// is none.
  bool find_fallback(uint32_t a, uint32_t b, Target* best) const {
    bool is_found = false;
    for (const double share : {0.5, 0.0, 1.0}) {
      const Target t = target_at(a, b, mesh_.point(a) + (mesh_.point(b) - mesh_.point(a)) * share);
      if ((is_found && t.error >= best->error) || !keeps_shape(a, b, t.position)) continue;
      *best = t;
      is_found = true;
    }
    return is_found;
  }

  /// The error that this collapse adds, not the error accumulated before.
  float cost(uint32_t a, uint32_t b, const Target& t) const {
    const double added = std::max(0.0, t.error - vertices_[a].error - vertices_[b].error);
    const Point along = mesh_.point(a) - mesh_.point(b);
    return static_cast<float>(added + kLengthWeight * dot(along, along) * dot(along, along));
  }

  void push(uint32_t a, uint32_t b, float cost, bool is_fallback) {
    queue_.push(cost, {a, b, versions_[a] + versions_[b], is_fallback});
  }

  void push(uint32_t first, uint32_t second) {
    const uint32_t a = std::min(first, second), b = std::max(first, second);
    push(a, b, cost(a, b, target(a, b)), false);
  }

  void fill_queue(const ck_control* control) {
    queue_ = {};
    std::vector<std::array<uint32_t, 2>> edges;
    for_alive([&](uint32_t i) {
      const Face& f = mesh_.face(i);
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = f[k], b = f[(k + 1) % 3];
        if (a < b || is_border(a, b)) edges.push_back({std::min(a, b), std::max(a, b)});
      }
    });
    std::vector<float> costs(edges.size());
    const ProgressPart start(control, 0, 0);
    parallel_for_blocks(start.control(), edges.size(), kBlock, [&](size_t i) {
      const auto [a, b] = edges[i];
      costs[i] = cost(a, b, target(a, b));
    });
    for (size_t i = 0; i < edges.size(); ++i) push(edges[i][0], edges[i][1], costs[i], false);
  }

  void collapse(const Collapse& c) {
    const uint32_t a = c.a, b = c.b;
    if (!mesh_.can_join(a, b)) return;
    Target t;
    if (c.is_fallback) {
      if (!find_fallback(a, b, &t)) return;
    } else {
      t = target(a, b);
      if (!keeps_shape(a, b, t.position)) {
        // The fallback position may cost far more, so it is queued.
        if (find_fallback(a, b, &t)) push(a, b, cost(a, b, t), true);
        return;
      }
    }
    alive_ -= mesh_.join(a, b);
    mesh_.move(a, t.position);
    vertices_[a] = {t.quadric, t.error, vertices_[a].is_border || vertices_[b].is_border};
    ++versions_[a];
    ++versions_[b];
    representatives_.attach(b, a);
    has_collapsed_ = true;
    mesh_.for_neighbors(a, [&](uint32_t v) { push(a, v); });
  }

  bool keeps_shape(uint32_t a, uint32_t b, const Point& p) const {
    return keeps_orientation(a, b, p) && keeps_orientation(b, a, p);
  }

  /// Whether the normals of the remaining triangles at `v` rotate by less than the limit when it
  /// moves to `p`.
  bool keeps_orientation(uint32_t v, uint32_t other, const Point& p) const {
    return mesh_.all_faces(v, [&](uint32_t i) {
      if (mesh_.has(i, other)) return true;
      const Point before = mesh_.normal(mesh_.face(i));
      const Point after = mesh_.normal(mesh_.face(i), v, p);
      const double before2 = dot(before, before), after2 = dot(after, after);
      if (!(after2 > 0)) return false;
      return !(before2 > 0) || dot(before, after) >= minimum_cosine_ * std::sqrt(before2 * after2);
    });
  }

  InputMesh input_;
  CollapseMesh mesh_;
  std::vector<Vertex> vertices_;
  std::vector<uint32_t> versions_;  ///< how often each vertex has changed
  DisjointSets representatives_;    ///< the vertex that each was merged into
  CollapseQueue queue_;
  size_t alive_ = 0;
  double minimum_cosine_ = 0;
  bool has_collapsed_ = false;
};

}  // namespace
}  // namespace ck::mesh

ck_status ck_simplify(ck_mutable_mesh* mesh, size_t maximum_triangles, const ck_control* control) {
  return ck::guarded([&] {
    ck::require(mesh && mesh->positions.data && mesh->triangles, "an argument is missing");
    ck::step(control, 0);
    ck::mesh::Simplifier simplifier({mesh->positions, mesh->triangles, mesh->triangle_count});
    // A closed component has at least four triangles: many tiny components would use up the budget.
    simplifier.drop_components(
        mesh->triangle_count,
        std::max<size_t>(1, maximum_triangles / ck::mesh::kTrianglesPerPiece));
    // A collapse that is rejected in one pass may be permitted after its surroundings have changed.
    // A limit on triangle shape is harmful: it prevents collapses that would repair slivers of the
    // input.
    for (const double cosine : ck::mesh::kTurnCosines)
      simplifier.run(maximum_triangles, cosine, control);
    simplifier.drop_components(maximum_triangles, maximum_triangles);
    simplifier.fit(control);
    simplifier.copy(mesh);
  });
}
