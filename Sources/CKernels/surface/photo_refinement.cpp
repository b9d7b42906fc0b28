#include "surface/photo_refinement.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/guard.h"
#include "core/parallel.h"
#include "core/span.h"

namespace ck::surface {

/// Sorts the directed edges; on a closed surface each occurs once per adjacent triangle, hence
/// twice.
void RefinedMesh::find_neighbors() {
  std::vector<uint64_t> edges;
  edges.reserve(6 * triangles.size());
  for (const auto& t : triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint64_t a = t[k], b = t[(k + 1) % 3];
      edges.push_back(a << 32 | b);
      edges.push_back(b << 32 | a);
    }
  }
  std::sort(edges.begin(), edges.end());
  offsets.assign(positions.size() + 1, 0);
  is_border.assign(positions.size(), 0);
  for (size_t i = 0, end; i < edges.size(); i = end) {
    for (end = i + 1; end < edges.size() && edges[end] == edges[i];) ++end;
    const auto from = static_cast<uint32_t>(edges[i] >> 32), to = static_cast<uint32_t>(edges[i]);
    if (end - i != 2) is_border[from] = 1;
    neighbors.push_back(to);
    ++offsets[from + 1];
    mean_edge += length(positions[to] - positions[from]);
  }
  for (size_t v = 0; v < positions.size(); ++v) offsets[v + 1] += offsets[v];
  mean_edge /= static_cast<double>(std::max<size_t>(1, neighbors.size()));
}

void RefinedMesh::find_normals() {
  normals.assign(positions.size(), {});
  for (const auto& t : triangles) {
    const Vec3 n = doubled_area(t);
    for (uint32_t v : t) normals[v] += n;
  }
  for (Vec3& n : normals) n = normalized(n);
}

namespace {

/// The number of views to compare concurrently: one per thread, fewer for large views.
size_t views_at_once(const std::vector<RefinementView>& views, const ck_control* control) {
  // Pixels that are compared concurrently. Chosen: each takes a few hundred bytes.
  constexpr size_t kMaximumPixels = 24'000'000;
  size_t largest = 1;
  for (const RefinementView& view : views) largest = std::max(largest, view.luminance.size());
  return std::clamp<size_t>(kMaximumPixels / largest, 1,
                            static_cast<size_t>(thread_count(control)));
}

/// Compares the views, several concurrently, and accumulates their evidence in a fixed order.
VertexEvidence gather(const RefinedMesh& mesh, const std::vector<RefinementView>& views,
                      const ck_photo_refinement_options& options, const ck_control* control,
                      double done, double share) {
  VertexEvidence sum{std::vector<double>(mesh.positions.size(), 0),
                     std::vector<double>(mesh.positions.size(), 0)};
  const ck_control quiet{nullptr, nullptr, thread_count(control)};
  const size_t batch = views_at_once(views, control);
  double footprints = 0;
  size_t pixels = 0;
  for (size_t first = 0; first < views.size(); first += batch) {
    step(control, done + share * static_cast<double>(first) / static_cast<double>(views.size()));
    const size_t count = std::min(batch, views.size() - first);
    std::vector<std::vector<PixelEvidence>> evidence_by_view(count);
    parallel_for(&quiet, count,
                 [&](size_t i) { evidence_by_view[i] = compare(mesh, views, first + i, options); });
    for (size_t i = 0; i < count; ++i) {
      for (const PixelEvidence& p : evidence_by_view[i]) {
        const auto& t = mesh.triangles[p.triangle];
        for (size_t k = 0; k < 3; ++k) {
          sum.slope2[t[k]] += static_cast<double>(p.weights[k]) * p.slope2;
          sum.pull[t[k]] += static_cast<double>(p.weights[k]) * p.pull;
        }
        const RefinementView& view = views[first + i];
        footprints += view.footprint(view.project(mesh.positions[t[0]]).z);
      }
      pixels += evidence_by_view[i].size();
    }
  }
  sum.footprint = footprints / static_cast<double>(std::max<size_t>(1, pixels));
  return sum;
}

}  // namespace
}  // namespace ck::surface

struct ck_photo_refinement {
  ck::surface::RefinedMesh mesh;
  std::vector<ck::surface::RefinementView> views;
  ck_photo_refinement_options options;
};

ck_status ck_photo_refinement_create(const ck_mesh* input,
                                     const ck_photo_refinement_options* options,
                                     const ck_control* control, ck_photo_refinement** refinement) {
  return ck::guarded([&] {
    ck::require(input && options && refinement, "null pointer");
    const auto [positions, triangles, triangle_count] = *input;
    ck::require(positions.count > 0 && triangle_count > 0, "the mesh has no triangles");
    ck::require(options->rounds >= 0 && options->neighbors >= 0 && options->radius > 0 &&
                    options->noise > 0 && options->minimum_correlation < 1 &&
                    options->smoothness >= 0,
                "the options of the refinement are out of range");
    *refinement = nullptr;
    ck::step(control, 0);
    auto result = std::make_unique<ck_photo_refinement>();
    result->options = *options;
    auto& mesh = result->mesh;
    for (size_t i = 0; i < positions.count; ++i) {
      const auto p = ck::vec_at(positions, i);
      ck::require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                  "a mesh vertex is not finite");
      mesh.positions.push_back(p);
    }
    for (size_t t = 0; t < triangle_count; ++t) {
      const uint32_t* v = triangles + 3 * t;
      ck::require(std::max({v[0], v[1], v[2]}) < positions.count,
                  "a triangle refers to a vertex that does not exist");
      mesh.triangles.push_back({v[0], v[1], v[2]});
    }
    mesh.find_neighbors();
    *refinement = result.release();
  });
}

ck_status ck_photo_refinement_add(ck_photo_refinement* refinement, const ck_view* view,
                                  const uint8_t* rgb, const uint8_t* mask,
                                  const ck_control* control) {
  return ck::guarded([&] {
    ck::require(refinement && view && rgb, "null pointer");
    ck::require(view->camera.width > 0 && view->camera.height > 0 && view->camera.fx > 0,
                "the view has no size");
    ck::step(control, 0);
    refinement->views.emplace_back(*view, rgb, mask);
    refinement->views.back().find_depths(refinement->mesh);
  });
}

ck_status ck_photo_refinement_run(ck_photo_refinement* refinement, const ck_control* control,
                                  ck_mutable_span positions, size_t* moved) {
  return ck::guarded([&] {
    ck::require(refinement && positions.data, "null pointer");
    auto& mesh = refinement->mesh;
    auto& views = refinement->views;
    const int rounds = refinement->options.rounds;
    std::vector<uint8_t> is_moved(mesh.positions.size(), 0);
    mesh.find_normals();
    ck::surface::choose_partners(mesh, refinement->options.neighbors, &views);
    for (int round = 0; round < rounds; ++round) {
      mesh.find_normals();
      const auto evidence = ck::surface::gather(mesh, views, refinement->options, control,
                                                static_cast<double>(round) / rounds, 1.0 / rounds);
      const auto now =
          ck::surface::move_vertices(evidence, refinement->options.smoothness, control, &mesh);
      for (size_t v = 0; v < now.size(); ++v) is_moved[v] |= now[v];
    }
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
      float* p = ck::MutableStrided<float>(positions)[v];
      p[0] = mesh.positions[v].x;
      p[1] = mesh.positions[v].y;
      p[2] = mesh.positions[v].z;
    }
    if (moved) {
      *moved = static_cast<size_t>(std::count(is_moved.begin(), is_moved.end(), uint8_t{1}));
    }
  });
}

void ck_photo_refinement_free(ck_photo_refinement* refinement) { delete refinement; }
