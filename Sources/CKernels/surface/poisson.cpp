#include <array>
#include <cstring>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/progress.h"
#include "core/span.h"
#include "surface/poisson/contour.h"
#include "surface/poisson/solution.h"
#include "surface/poisson/solution_bytes.h"

using namespace ck::poisson;

struct ck_surface {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
};

struct ck_poisson_solution {
  Solution value;
};

namespace {

void require_depth(int32_t depth) {
  // Limit: of the numbers of cells.
  ck::require(depth >= kFirstDepth && depth <= 14, "depth must be 2 to 14");
}

void require_as_many(ck_span positions, ck_span normals) {
  ck::require(positions.data && normals.data, "null pointer");
  ck::require(positions.count == normals.count, "as many normals as positions are needed");
}

CellBox box_of(const ck_cell_box* box) {
  CellBox result;
  if (!box) return result;
  ck::require(box->depth >= 0 && box->depth <= 14, "depth of a box must be 0 to 14");
  result.depth = box->depth;
  for (size_t a = 0; a < 3; ++a) {
    result.low[a] = box->low[a];
    result.high[a] = box->high[a];
  }
  return result;
}

}  // namespace

ck_status ck_poisson_solve(ck_span positions, ck_span normals, const ck_poisson_options* options,
                           const ck_control* control, ck_poisson_solution** solution) {
  return ck::guarded([&] {
    ck::require(options && solution, "null pointer");
    require_as_many(positions, normals);
    require_depth(options->depth);
    ck::require(options->scale >= 1, "scale must be 1 or more");
    ck::step(control, 0);
    Cube cube;
    std::copy(options->cube_origin, options->cube_origin + 3, cube.origin.begin());
    cube.side = options->cube_side;
    Samples samples(positions, normals, options->scale, cube, control);
    *solution = new ck_poisson_solution{
        ck::poisson::solution(std::move(samples), options->depth, options->maximum_bytes, control)};
  });
}

ck_status ck_poisson_refine(const ck_poisson_solution* base, ck_span positions, ck_span normals,
                            int32_t depth, const ck_control* control,
                            ck_poisson_solution** solution) {
  return ck::guarded([&] {
    ck::require(base && solution, "null pointer");
    require_as_many(positions, normals);
    require_depth(depth);
    ck::require(depth >= base->value.depth(), "the base is deeper");
    ck::step(control, 0);
    Samples samples(positions, normals, 1, base->value.cube, control);
    *solution = new ck_poisson_solution{refined(base->value, std::move(samples), depth, control)};
  });
}

ck_status ck_poisson_adopt(ck_poisson_solution* solution, const ck_poisson_solution* other,
                           int32_t base_depth, const ck_cell_box* box, const ck_control* control) {
  return ck::guarded([&] {
    ck::require(solution && other && box, "null pointer");
    ck::require(base_depth >= kFirstDepth, "the base has no levels");
    const auto shared = static_cast<size_t>(base_depth - kFirstDepth + 1);
    adopt(solution->value, other->value, shared, box_of(box), control);
  });
}

ck_status ck_poisson_surface(const ck_poisson_solution* solution, const ck_cell_box* box,
                             const ck_control* control, ck_surface** surface) {
  return ck::guarded([&] {
    ck::require(solution && surface, "null pointer");
    const Solution& value = solution->value;
    Contour found = contour(value.levels, value.value, box_of(box), control);
    for (std::array<float, 3>& p : found.positions) {
      for (size_t a = 0; a < 3; ++a) {
        p[a] = static_cast<float>(value.cube.origin[a] + value.cube.side * p[a]);
      }
    }
    *surface = new ck_surface{std::move(found.positions), std::move(found.triangles)};
  });
}

int32_t ck_poisson_depth(const ck_poisson_solution* solution) { return solution->value.depth(); }

void ck_poisson_cube(const ck_poisson_solution* solution, double* origin, double* side) {
  const Cube& cube = solution->value.cube;
  std::copy(cube.origin.begin(), cube.origin.end(), origin);
  *side = cube.side;
}

ck_status ck_poisson_encode(const ck_poisson_solution* solution, const ck_cell_box* box,
                            void (*write)(void* context, const void* bytes, size_t count),
                            void* context) {
  return ck::guarded([&] {
    ck::require(solution && write, "null pointer");
    const std::vector<uint8_t> bytes = encoded(solution->value, box_of(box));
    write(context, bytes.data(), bytes.size());
  });
}

ck_status ck_poisson_decode(const void* bytes, size_t count, const ck_cell_box* box,
                            const ck_control* control, ck_poisson_solution** solution) {
  return ck::guarded([&] {
    ck::require(bytes && solution, "null pointer");
    *solution = new ck_poisson_solution{
        decoded(static_cast<const uint8_t*>(bytes), count, box_of(box), control)};
  });
}

void ck_poisson_free(ck_poisson_solution* solution) { delete solution; }

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
