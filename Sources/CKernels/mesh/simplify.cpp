#include "mesh/simplifier.h"

#include <algorithm>

#include "ck_mesh.h"
#include "core/guard.h"

namespace ck::mesh {
namespace {

/// Cosine of the largest angle by which a collapse may rotate a triangle's normal, in each of the
/// passes; the last one permits collapses that the others rejected. Chosen: by trial.
constexpr double kTurnCosines[] = {0.2, 0.2, 0.0};
/// The number of components is limited to one per this number of triangles of the result. Chosen:
/// by trial.
constexpr size_t kTrianglesPerPiece = 16;

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
