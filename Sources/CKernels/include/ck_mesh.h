#ifndef CK_MESH_H
#define CK_MESH_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A triangle mesh.
typedef struct {
  /// 3 floats.
  ck_span positions;
  /// Three vertex indices each, counter-clockwise seen from outside.
  const uint32_t* triangles;
  size_t triangle_count;
} ck_mesh;

/// A triangle mesh that a kernel modifies in place.
typedef struct {
  /// 3 floats.
  ck_mutable_span positions;
  uint32_t* triangles;
  size_t triangle_count;
} ck_mutable_mesh;

/// Simplifies a mesh by edge collapse with quadric error metrics (Garland and Heckbert, SIGGRAPH
/// 1997) until at most `maximum_triangles` are left, then fits the vertices to the original surface
/// (after Hoppe et al., SIGGRAPH 1993).
///
/// Collapses preserve the topology and do not fold the surface. Where they do not suffice, the
/// components with the smallest areas are removed; the largest one is kept, even if it has more
/// triangles than requested. Before that, degenerate and duplicate triangles are removed, and so
/// are the smallest components if there are more than one per 16 requested triangles.
///
/// Positions and triangles are moved and compacted in place; on return the counts of `mesh` are
/// those of the simplified mesh.
ck_status ck_simplify(ck_mutable_mesh* mesh, size_t maximum_triangles, const ck_control* control);

#ifdef __cplusplus
}
#endif
#endif
