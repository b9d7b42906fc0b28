#include "mesh/surface_fit.h"

#include <algorithm>
#include <limits>

#include "core/guard.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace ck::mesh {
namespace {

/// Rounds of projecting the samples, and sweeps of moving the vertices in each. Chosen.
constexpr size_t kRounds = 2, kSweeps = 2;
/// Number of samples that a thread works on at a time. Chosen: about a millisecond.
constexpr size_t kBlock = 8192;
/// The same for vertices, which have some tens of samples each. Chosen.
constexpr size_t kVertices = 512;
/// Limit: colors are bits of 64. More than about ten occur only around vertices of extreme degree.
constexpr uint8_t kLastColor = 63, kUncolored = 255;
/// Regularization weight, as a fraction of the weight of the planes, for directions that the
/// samples do not determine, for example within a plane. Chosen.
constexpr double kPull = 2e-3;
/// Fraction of the displacement to apply. Chosen: a mesh that is right on average bulges at its
/// vertices, which form its outline.
constexpr double kPart = 0.8;
/// Cosine of the largest rotation of a triangle's normal in total: 60°. Chosen.
constexpr double kMinimumCosine = 0.5;

/// Barycentric weights of the point of a triangle nearest to `p` (Ericson, "Real-Time Collision
/// Detection", 2005, 5.1.5).
Point nearest_weights(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

Point unit(const Point& n) {
  const double length2 = dot(n, n);
  return length2 > 0 ? n * (1 / std::sqrt(length2)) : Point{0, 0, 0};
}

}  // namespace

SurfaceFit::SurfaceFit(const InputMesh& input, const std::vector<uint32_t>& representatives,
                       CollapseMesh* mesh, CollapseMesh::Marks marks)
    : mesh_(*mesh), initial_normals_(mesh->face_count()), normals_(mesh->face_count()) {
  samples_.reserve(input.triangle_count + input.positions.count);
  std::vector<double> areas(input.positions.count, 0);
  for (size_t t = 0; t < input.triangle_count; ++t) {
    const uint32_t* f = input.triangles + 3 * t;
    const Point a = input.point(f[0]), b = input.point(f[1]), c = input.point(f[2]);
    const Point n = cross(b - a, c - a);
    const double area = std::sqrt(dot(n, n)) / 2;
    // Centroid and corners in this proportion integrate any quadratic function exactly.
    add((a + b + c) * (1.0 / 3), area * 3 / 4, representatives[f[0]]);
    for (size_t k = 0; k < 3; ++k) areas[f[k]] += area / 12;
  }
  for (size_t v = 0; v < areas.size(); ++v) add(input.point(v), areas[v], representatives[v]);
  for (size_t f = 0; f < initial_normals_.size(); ++f) {
    if (mesh_.is_alive(f)) initial_normals_[f] = unit(mesh_.normal(mesh_.face(f)));
  }
  for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
    if (!mesh_.is_used(v) || mesh_.is_border(v, marks)) continue;
    movable_.push_back(v);
  }
  color(marks);
  for (const uint32_t v : movable_) starts_.push_back(mesh_.point(v));
}

void SurfaceFit::add(const Point& position, double area, uint32_t representative) {
  // The vertex is unused if its component was removed.
  if (!(area > 0) || !mesh_.is_used(representative)) return;
  samples_.push_back({{static_cast<float>(position[0]), static_cast<float>(position[1]),
                       static_cast<float>(position[2])},
                      static_cast<float>(area),
                      {},
                      representative});
}

void SurfaceFit::color(CollapseMesh::Marks marks) {
  std::vector<std::vector<uint32_t>> by_color;
  // One color for each vertex; the bits of those that its neighbors have.
  std::vector<uint8_t> colors(mesh_.vertex_count(), kUncolored);
  for (const uint32_t v : movable_) {
    uint64_t taken = 0;
    mesh_.for_neighbors(v, marks, [&](uint32_t w) {
      if (colors[w] != kUncolored) taken |= uint64_t(1) << colors[w];
    });
    // Vertices with more than 63 colors around them share the last one, which is not parallel.
    uint8_t color = 0;
    while (color < kLastColor && (taken >> color & 1)) ++color;
    colors[v] = color;
    if (by_color.size() <= color) by_color.resize(color + size_t(1));
    by_color[color].push_back(v);
  }
  movable_.clear();
  colors_ = {0};
  for (const auto& vertices : by_color) {
    movable_.insert(movable_.end(), vertices.begin(), vertices.end());
    colors_.push_back(movable_.size());
  }
}

template <typename Body>
void SurfaceFit::for_movable(const ck_control* control, Body&& body) {
  const ProgressPart end(control, 1, 1);
  for (size_t color = 0; color + 1 < colors_.size(); ++color) {
    const size_t count = colors_[color + 1] - colors_[color];
    const size_t block = color == kLastColor ? count : kVertices;
    parallel_for_blocks(end.control(), count, block, [&](size_t i) { body(colors_[color] + i); });
  }
}

void SurfaceFit::run(const ck_control* control) {
  for (size_t round = 0; round < kRounds; ++round) {
    find_faces(round == 0, control);
    group();
    step(control, 1);
    for (size_t sweep = 0; sweep < kSweeps; ++sweep) {
      for_movable(control, [&](size_t i) { fit_vertex(movable_[i]); });
    }
  }
  for_movable(control, [&](size_t i) {
    const uint32_t v = movable_[i];
    move(v, starts_[i] + (mesh_.point(v) - starts_[i]) * kPart);
  });
}

void SurfaceFit::find_faces(bool is_first, const ck_control* control) {
  const ProgressPart end(control, 1, 1);
  parallel_for_blocks(end.control(), samples_.size(), kBlock,
                      [&](size_t i) { find_face(is_first, samples_[i]); });
}

void SurfaceFit::find_face(bool is_first, Sample& s) const {
  uint32_t center = s.face;
  if (!is_first) {
    place(&s, s.face);
    const auto [least, most] = std::minmax_element(s.weights.begin(), s.weights.end());
    if (*least > 0) return;
    center = mesh_.face(s.face)[static_cast<size_t>(most - s.weights.begin())];
  }
  double best = std::numeric_limits<double>::infinity();
  Sample found = s;
  mesh_.for_faces(center, [&](uint32_t i) {
    const double distance2 = place(&s, i);
    if (!(distance2 < best) && best < std::numeric_limits<double>::infinity()) return;
    best = distance2;
    found = s;
  });
  s = found;
}

double SurfaceFit::place(Sample* s, uint32_t face) const {
  const auto& f = mesh_.face(face);
  const Point p = {s->position[0], s->position[1], s->position[2]};
  const Point &a = mesh_.point(f[0]), &b = mesh_.point(f[1]), &c = mesh_.point(f[2]);
  const Point w = nearest_weights(p, a, b, c);
  const Point d = p - (a * w[0] + b * w[1] + c * w[2]);
  s->face = face;
  for (size_t k = 0; k < 3; ++k) s->weights[k] = static_cast<float>(w[k]);
  return dot(d, d);
}

void SurfaceFit::group() {
  offsets_.assign(mesh_.face_count() + 1, 0);
  for (const Sample& s : samples_) ++offsets_[s.face + 1];
  for (size_t f = 0; f < mesh_.face_count(); ++f) offsets_[f + 1] += offsets_[f];
  order_.resize(samples_.size());
  std::vector<uint32_t> ends(offsets_.begin(), offsets_.end() - 1);
  for (uint32_t i = 0; i < samples_.size(); ++i) order_[ends[samples_[i].face]++] = i;
  for (size_t f = 0; f < normals_.size(); ++f) {
    if (mesh_.is_alive(f)) normals_[f] = unit(mesh_.normal(mesh_.face(f)));
  }
}

void SurfaceFit::fit_vertex(uint32_t v) {
  Quadric q;  // As a function of the displacement.
  mesh_.for_faces(v, [&](uint32_t i) {
    const auto& f = mesh_.face(i);
    const Point &n = normals_[i], &a = mesh_.point(f[0]);
    const double height_b = dot(n, mesh_.point(f[1]) - a);
    const double height_c = dot(n, mesh_.point(f[2]) - a);
    const size_t corner = f[0] == v ? 0 : f[1] == v ? 1 : 2;
    double weight = 0, pull = 0;
    for (uint32_t k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      const Sample& s = samples_[order_[k]];
      const Point p = {s.position[0], s.position[1], s.position[2]};
      const double height = dot(n, p - a) - s.weights[1] * height_b - s.weights[2] * height_c;
      const double share = static_cast<double>(s.area) * s.weights[corner];
      weight += share * s.weights[corner];
      pull += share * height;
    }
    q.add_direction(n, weight, pull);
  });
  move(v, mesh_.point(v) + q.minimizer({0, 0, 0}, kPull));
}

void SurfaceFit::move(uint32_t v, const Point& p) {
  const bool keeps_orientation = mesh_.all_faces(v, [&](uint32_t i) {
    const Point n = mesh_.normal(mesh_.face(i), v, p);
    const double length2 = dot(n, n);
    return length2 > 0 && dot(n, initial_normals_[i]) >= kMinimumCosine * std::sqrt(length2);
  });
  if (keeps_orientation) mesh_.move(v, p);
}

}  // namespace ck::mesh
