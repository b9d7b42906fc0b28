#include "mesh/simplifier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/guard.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace ck::mesh {
namespace {

using Face = CollapseMesh::Face;

/// A new vertex is regularized toward the midpoint of its edge with this fraction of the weight of
/// its planes, and is at most `kReach` edge lengths from it: nearly parallel planes intersect far
/// away. Chosen.
constexpr double kPull = 1e-4, kReach = 2;
/// Weight of the fourth power of an edge's length in its cost: among edges without error the
/// shortest are collapsed first. Chosen: about the error of a plane at 3 · 10⁻⁵ edge lengths.
constexpr double kLengthWeight = 1e-9;
/// Number of edges or vertices that a thread works on at a time. Chosen: about a millisecond.
constexpr size_t kBlock = 8192;
/// Triangles of a cell. Chosen: some ten milliseconds of work, and most vertices are inside.
constexpr size_t kFacesPerCell = 8192;
/// A mesh that would have fewer cells is simplified as a whole. Chosen.
constexpr size_t kFewestCells = 4;
/// Cells are left when this many times the triangles of the result are left. Chosen: then edges
/// between cells compete with the others on equal terms.
constexpr double kGoal = 1.25;
/// The first limit of the costs in cells is the median of about this many edges. Chosen: its rank
/// is then within 1 % of the middle.
constexpr size_t kSampledEdges = 10'000;
/// Limits grow as this power of the ratio of triangles to the goal. Chosen: a round does not
/// overshoot, since half as many triangles have four times the squared distance on twice the area,
/// so that costs grow as the third power.
constexpr double kGrowth = 2;
/// A round that removes a smaller share of the triangles is the last in cells. Chosen.
constexpr double kLeastProgress = 0.02;

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
  const auto face = [&](size_t t) {
    const uint32_t* corners = input.triangles + 3 * t;
    return Face{corners[0], corners[1], corners[2]};
  };
  const auto sorted = [&](size_t t) {
    Face f = face(t);
    std::sort(f.begin(), f.end());
    return f;
  };
  // The triangles at each vertex of which it is the lowest: few have to be compared.
  std::vector<uint32_t> last(input.positions.count, CollapseMesh::kNone);
  std::vector<uint32_t> earlier(input.triangle_count, CollapseMesh::kNone);
  std::vector<Face> faces;
  faces.reserve(input.triangle_count);
  for (size_t t = 0; t < input.triangle_count; ++t) {
    const Face f = sorted(t);
    require(f[2] < input.positions.count, "a triangle refers to a vertex that does not exist");
    if (f[0] == f[1] || f[1] == f[2]) continue;
    uint32_t other = last[f[0]];
    while (other != CollapseMesh::kNone && sorted(other) != f) other = earlier[other];
    if (other != CollapseMesh::kNone) continue;
    earlier[t] = std::exchange(last[f[0]], uint32_t(t));
    faces.push_back(face(t));
  }
  return faces;
}

}  // namespace

Simplifier::Simplifier(const InputMesh& input)
    : input_(input),
      mesh_(load_points(input), load_faces(input)),
      vertices_(input.positions.count),
      versions_(input.positions.count, 0),
      representatives_(input.positions.count),
      alive_(mesh_.face_count()) {
  for (uint32_t v = 0; v < vertices_.size(); ++v) {
    vertices_[v].is_border = mesh_.is_border(v, marks_);
  }
  add_quadrics();
}

void Simplifier::run(size_t maximum, double cosine, const ck_control* control) {
  minimum_cosine_ = cosine;
  run_in_cells(size_t(kGoal * double(maximum)), control);
  run_everywhere(maximum, control);
}

/// Rounds in two grids in turn, as long as they make progress.
void Simplifier::run_in_cells(size_t goal, const ck_control* control) {
  const ProgressPart start(control, 0, 0);
  if (alive_ < std::max(2 * goal, kFewestCells * kFacesPerCell)) return;
  float limit = initial_limit();
  for (bool is_shifted = false; alive_ > goal; is_shifted = !is_shifted) {
    const MeshCells cells(mesh_, alive_, kFacesPerCell, is_shifted, start.control());
    // Where many edges cost the same, a limit of the cost alone might remove too much.
    const double share = 1 - double(goal) / double(alive_);
    std::vector<CollapseMesh::Marks> marks(cells.count(), marks_);
    std::vector<size_t> counts(cells.count(), 0);
    parallel_for(start.control(), cells.count(), [&](size_t cell) {
      if (cells.is_empty(cell)) return;
      Front front{&cells, cell, limit, marks_, {}, 0};
      run_in_cell(front, size_t(share * double(cells.face_count(cell))));
      marks[cell] = front.marks;
      counts[cell] = front.removed;
    });
    marks_ = *std::max_element(marks.begin(), marks.end());
    const size_t removed = std::accumulate(counts.begin(), counts.end(), size_t(0));
    const bool has_progressed = double(removed) > kLeastProgress * double(alive_);
    alive_ -= removed;
    has_collapsed_ = has_collapsed_ || removed > 0;
    if (!has_progressed) break;
    limit *= float(std::pow(double(alive_) / double(goal), kGrowth));
  }
}

/// The median cost of an edge, of a sample.
float Simplifier::initial_limit() const {
  std::vector<float> costs;
  const size_t stride = std::max<size_t>(1, mesh_.face_count() / kSampledEdges);
  for (size_t i = 0; i < mesh_.face_count(); i += stride) {
    if (!mesh_.is_alive(i)) continue;
    const Face& f = mesh_.face(i);
    costs.push_back(cost(f[0], f[1], target(f[0], f[1])));
  }
  const auto middle = costs.begin() + std::ptrdiff_t(costs.size() / 2);
  std::nth_element(costs.begin(), middle, costs.end());
  return costs.empty() ? 0 : *middle;
}

void Simplifier::run_in_cell(Front& front, size_t maximum) {
  front.cells->for_faces(front.cell, [&](uint32_t face) {
    for_edges(face, [&](uint32_t a, uint32_t b) { push(front, a, b); });
  });
  Collapse c;
  while (front.removed < maximum && front.queue.pop(&c)) {
    if (is_current(c)) collapse(front, c);
  }
}

void Simplifier::run_everywhere(size_t maximum, const ck_control* control) {
  if (alive_ <= maximum) return;
  Front front;
  front.marks = marks_;
  fill(front, control);
  const size_t start = alive_;
  size_t count = 0;
  Collapse c;
  while (start - front.removed > maximum && front.queue.pop(&c)) {
    if (++count % kBlock == 0) {
      step(control, static_cast<double>(front.removed) / static_cast<double>(start - maximum));
    }
    if (is_current(c)) collapse(front, c);
  }
  alive_ -= front.removed;
  has_collapsed_ = has_collapsed_ || front.removed > 0;
  marks_ = front.marks;
}

/// Queues all edges.
void Simplifier::fill(Front& front, const ck_control* control) {
  std::vector<std::array<uint32_t, 2>> edges;
  for_alive([&](uint32_t i) {
    for_edges(i, [&](uint32_t a, uint32_t b) { edges.push_back({a, b}); });
  });
  std::vector<float> costs(edges.size());
  const ProgressPart start(control, 0, 0);
  parallel_for_blocks(start.control(), edges.size(), kBlock, [&](size_t i) {
    const auto [a, b] = edges[i];
    costs[i] = cost(a, b, target(a, b));
  });
  for (size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    push(front, {a, b, versions_[a] + versions_[b], false}, costs[i]);
  }
}

void Simplifier::push(Front& front, const Collapse& c, float cost) {
  if (cost <= front.limit) front.queue.push(cost, c);
}

void Simplifier::push(Front& front, uint32_t first, uint32_t second) {
  const uint32_t a = std::min(first, second), b = std::max(first, second);
  if (!front.permits(a) || !front.permits(b)) return;
  push(front, {a, b, versions_[a] + versions_[b], false}, cost(a, b, target(a, b)));
}

void Simplifier::collapse(Front& front, const Collapse& c) {
  const uint32_t a = c.a, b = c.b;
  if (!mesh_.can_join(a, b, front.marks)) return;
  Target t;
  if (c.is_fallback) {
    if (!find_fallback(a, b, &t)) return;
  } else {
    t = target(a, b);
    if (!keeps_shape(a, b, t.position)) {
      // The fallback position may cost far more, so it is queued.
      if (find_fallback(a, b, &t)) push(front, {a, b, c.version, true}, cost(a, b, t));
      return;
    }
  }
  front.removed += mesh_.join(a, b);
  mesh_.move(a, t.position);
  vertices_[a] = {t.quadric, t.error, vertices_[a].is_border || vertices_[b].is_border};
  ++versions_[a];
  ++versions_[b];
  representatives_.attach(b, a);
  mesh_.for_neighbors(a, front.marks, [&](uint32_t v) { push(front, a, v); });
}

void Simplifier::drop_components(size_t maximum, size_t maximum_pieces) {
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

void Simplifier::fit(const ck_control* control) {
  if (!has_collapsed_) return;
  const std::vector<uint32_t> homes = representatives_.roots();
  SurfaceFit(input_, homes, &mesh_, marks_).run(control);
}

void Simplifier::copy(ck_mutable_mesh* result) const {
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

void Simplifier::add_quadrics() {
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
void Simplifier::add_border(uint32_t a, uint32_t b, const Point& n) {
  const Point side = cross(mesh_.point(b) - mesh_.point(a), n);
  const double length2 = dot(side, side);
  if (!(length2 > 0)) return;
  Quadric q;
  q.add_plane(side * (1 / std::sqrt(length2)), mesh_.point(a), length2);
  vertices_[a].quadric += q;
  vertices_[b].quadric += q;
}

Simplifier::Target Simplifier::target_at(uint32_t a, uint32_t b, const Point& p) const {
  Quadric q = vertices_[a].quadric;
  q += vertices_[b].quadric;
  return {q, p, std::max(0.0, q(p))};
}

/// The position of least error.
Simplifier::Target Simplifier::target(uint32_t a, uint32_t b) const {
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
bool Simplifier::find_fallback(uint32_t a, uint32_t b, Target* best) const {
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
float Simplifier::cost(uint32_t a, uint32_t b, const Target& t) const {
  const double added = std::max(0.0, t.error - vertices_[a].error - vertices_[b].error);
  const Point along = mesh_.point(a) - mesh_.point(b);
  return static_cast<float>(added + kLengthWeight * dot(along, along) * dot(along, along));
}

bool Simplifier::keeps_shape(uint32_t a, uint32_t b, const Point& p) const {
  return keeps_orientation(a, b, p) && keeps_orientation(b, a, p);
}

/// Whether the normals of the remaining triangles at `v` rotate by less than the limit when it
/// moves to `p`.
bool Simplifier::keeps_orientation(uint32_t v, uint32_t other, const Point& p) const {
  return mesh_.all_faces(v, [&](uint32_t i) {
    if (mesh_.has(i, other)) return true;
    const Point before = mesh_.normal(mesh_.face(i));
    const Point after = mesh_.normal(mesh_.face(i), v, p);
    const double before2 = dot(before, before), after2 = dot(after, after);
    if (!(after2 > 0)) return false;
    return !(before2 > 0) || dot(before, after) >= minimum_cosine_ * std::sqrt(before2 * after2);
  });
}

}  // namespace ck::mesh
