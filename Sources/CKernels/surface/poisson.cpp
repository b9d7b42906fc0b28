#include <array>
#include <cstring>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/span.h"
#include "surface/poisson/contour.h"
#include "surface/poisson/density.h"
#include "surface/poisson/solver.h"

struct ck_surface {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
  int depth;
};

namespace {

using namespace ck::poisson;

ck_surface reconstruct(Samples samples, int depth, size_t maximum_bytes,
                       const ck_control* control) {
  // Measured: the shares of the time on boot and orbit.
  const ck::ProgressPart density(control, 0, 0.07), octree(control, 0.07, 0.2),
      solving(control, 0.2, 0.73), averaging(control, 0.73, 0.75), contouring(control, 0.75, 1);
  estimate_density(samples, depth, density.control());
  std::vector<Level> levels = make_levels(samples, depth, maximum_bytes, octree.control());
  solve(levels, samples, solving.control());
  const double value = mean_value(levels, samples, averaging.control());
  Contour found = contour(levels, value, contouring.control());
  for (std::array<float, 3>& p : found.positions) {
    for (size_t a = 0; a < 3; ++a) {
      p[a] = static_cast<float>(samples.origin[a] + samples.side * p[a]);
    }
  }
  return {std::move(found.positions), std::move(found.triangles), depth};
}

}  // namespace

ck_status ck_poisson(ck_span positions, ck_span normals, const ck_poisson_options* options,
                     const ck_control* control, ck_surface** surface) {
  return ck::guarded([&] {
    ck::require(positions.data && normals.data && options && surface, "null pointer");
    ck::require(positions.count == normals.count, "as many normals as positions are needed");
    ck::require(options->depth >= 2 && options->depth <= 14, "depth must be 2 to 14");
    ck::require(options->scale >= 1, "scale must be 1 or more");
    ck::step(control, 0);
    const ck::Strided<float> p(positions), n(normals);
    *surface = new ck_surface(reconstruct(Samples(p, n, options->scale, control), options->depth,
                                          options->maximum_bytes, control));
  });
}

int32_t ck_surface_depth(const ck_surface* surface) { return surface->depth; }

size_t ck_surface_vertex_count(const ck_surface* surface) { return surface->positions.size(); }

size_t ck_surface_triangle_count(const ck_surface* surface) { return surface->triangles.size(); }

void ck_surface_copy(const ck_surface* surface, ck_mutable_span positions, uint32_t* triangles) {
  const ck::MutableStrided<float> output(positions);
  for (size_t i = 0; i < surface->positions.size(); ++i) {
    std::memcpy(output[i], surface->positions[i].data(), 3 * sizeof(float));
  }
  for (size_t t = 0; t < surface->triangles.size(); ++t) {
    std::memcpy(triangles + 3 * t, surface->triangles[t].data(), 3 * sizeof(uint32_t));
  }
}

void ck_surface_free(ck_surface* surface) { delete surface; }
