#ifndef CK_TEXTURE_H
#define CK_TEXTURE_H

#include "ck_rays.h"

#ifdef __cplusplus
extern "C" {
#endif

// Texel coordinates have their origin at the corner of the top-left texel, y down.

/// Two nodes of a graph that should have the same label.
typedef struct {
  uint32_t nodes[2];
  /// Cost of different labels.
  float weight;
} ck_label_edge;

/// A labeling problem: every node of a graph gets one of its candidate labels.
typedef struct {
  size_t node_count;
  /// Node i has the candidates `offsets[i]..<offsets[i + 1]`.
  const uint32_t* offsets;
  /// Labels of the candidates, ascending for each node.
  const int32_t* labels;
  /// Cost of each candidate.
  const float* costs;
  size_t edge_count;
  const ck_label_edge* edges;
} ck_label_problem;

/// Selects one candidate label for every node such that the sum of the nodes' costs and of the
/// weights of edges between different labels is small: a Potts model, minimized by tree-reweighted
/// message passing (Kolmogorov, PAMI 2006).
///
/// A node has fewer than 65,535 candidates. Fastest if nodes that an edge joins have close indices.
///
/// An iteration passes messages forward and backward once. `choices` receives the index of each
/// node's selected candidate among its candidates, −1 for nodes without candidates; it does not
/// depend on the number of threads.
ck_status ck_select_labels(const ck_label_problem* problem, size_t iterations,
                           const ck_control* control, int32_t* choices);

/// A sparse symmetric positive definite matrix, given by the entries of its lower triangle and
/// diagonal; entries at equal positions are added.
typedef struct {
  /// Number of rows and columns.
  size_t size;
  size_t entry_count;
  const uint32_t* rows;
  const uint32_t* columns;
  const double* entries;
} ck_sparse_matrix;

/// Termination criteria of conjugate gradients.
typedef struct {
  /// Norm of the residual relative to that of the right-hand side.
  double tolerance;
  size_t maximum_iterations;
} ck_conjugate_gradient_options;

/// Solves a system for several right-hand sides by conjugate gradients; the initial value is zero.
///
/// `values` holds `size × channels` numbers, row-major: the right-hand sides on entry, the
/// solutions on return. Returns `ck_degenerate` if there is no finite solution.
ck_status ck_solve_sparse(const ck_sparse_matrix* matrix, size_t channels,
                          const ck_conjugate_gradient_options* options, const ck_control* control,
                          double* values);

/// Limits on the charts.
typedef struct {
  /// Half-angle of the cone that contains all normals of a chart, in radians, below π/2.
  float maximum_angle;
  /// Charts with a smaller fraction of the surface area are merged with a neighbor if that does not
  /// fold them.
  float minimum_share;
} ck_chart_options;

/// Segments the mesh into connected, compact charts that can be projected onto a plane without
/// folding: hierarchical face clustering (Garland et al., I3D 2001) on cones of normals, then
/// boundary shortening by multilevel refinement (after Karypis and Kumar, SIAM J. Sci. Comput.
/// 1998).
///
/// `charts` receives the chart index of every triangle, numbered consecutively from 0; `axes` three
/// floats per chart: the unit projection direction. `axes` has room for as many charts as there are
/// triangles.
ck_status ck_cluster_faces(const ck_mesh* mesh, const ck_chart_options* options,
                           const ck_control* control, int32_t* charts, float* axes,
                           size_t* chart_count);

/// Placement of a chart in an atlas: `texel = scale · R(quarter_turns) · plane + offset`.
typedef struct {
  float scale;
  /// Number of rotations by 90° from x to y.
  int32_t quarter_turns;
  float offset[2];
  /// Index of the atlas page that holds the chart.
  int32_t atlas;
} ck_chart_placement;

/// The atlas pages to pack charts into.
typedef struct {
  /// Side of the square pages in texels.
  int32_t side;
  int32_t atlas_count;
  /// Empty texels between charts; half as many along the page border, because the texture may
  /// repeat.
  int32_t padding;
  /// Upper bound of the texels per unit of length.
  float maximum_scale;
} ck_pack_options;

/// Packs charts into square pages at the largest common scale that fits, by their shapes rather
/// than their bounding boxes. `corners` are the plane coordinates of each triangle's three corners
/// (6 floats); `density` scales each chart relative to the others (1: the common scale).
/// `placements` holds one element per chart. Returns `ck_degenerate` if the charts do not fit.
ck_status ck_pack_charts(const float* corners, const int32_t* charts, size_t triangle_count,
                         const float* density, size_t chart_count, const ck_pack_options* options,
                         const ck_control* control, ck_chart_placement* placements);

/// A texture under construction: the triangle and the color of every texel.
typedef struct ck_atlas ck_atlas;

/// Creates an atlas page. `corners` are the texel coordinates of each triangle's three corners (6
/// floats). Texels up to `gutter` outside a chart are assigned to its boundary triangles, so that
/// texture filtering across the boundary finds their color. Copies the corners; the scene must
/// outlive the atlas. Free with `ck_atlas_free`.
ck_status ck_atlas_create(const ck_ray_scene* scene, const float* corners, size_t triangle_count,
                          int32_t side, int32_t gutter, const ck_control* control,
                          ck_atlas** atlas);

/// Frees the atlas; null does nothing.
void ck_atlas_free(ck_atlas* atlas);

/// Number of texels whose center lies in a triangle, without the gutter.
size_t ck_atlas_covered_count(const ck_atlas* atlas);

/// Number of texels that more than one triangle covers.
size_t ck_atlas_overlap_count(const ck_atlas* atlas);

/// Contribution of a view to a triangle: at each corner a weight, and a color offset that is added
/// to the photo's color. The weights of a corner over all views add up to 1.
typedef struct {
  /// Index of the triangle.
  uint32_t face;
  /// One per corner.
  float weights[3];
  /// RGB in gray levels (0…255) for each corner.
  float offsets[9];
} ck_paint;

/// Adds a view's colors, multiplied by `gain` (3 floats, one per channel). `rgb` has 3 bytes per
/// pixel; if it is null, only the offsets are painted, and `view` and `gain` may be null.
ck_status ck_atlas_paint(ck_atlas* atlas, const ck_view* view, const uint8_t* rgb,
                         const float* gain, const ck_paint* paints, size_t paint_count,
                         const ck_control* control);

/// Writes the `side² × 3` bytes of the texture; the space between charts is filled from their
/// boundaries.
ck_status ck_atlas_copy_colors(const ck_atlas* atlas, const ck_control* control, uint8_t* rgb);

/// Input of the maps that transfer detail from a dense to a simplified surface.
typedef struct {
  /// Search distance from the simplified to the dense surface, in world units.
  float maximum_distance;
  /// 9 floats per triangle: unit normals at its corners.
  const float* corner_normals;
  /// 12 floats per triangle: at each corner the unit tangent (along u) and the sign of the
  /// bitangent.
  const float* corner_tangents;
  /// The surface before simplification.
  const ck_ray_scene* dense;
  /// One normal (3 floats) for each position of `dense`.
  ck_span dense_normals;
} ck_bake_source;

/// Bakes a tangent-space normal map of `side² × 3` bytes: the normals of the dense surface in the
/// tangent frame of the simplified one, flat where no dense surface is found; and, if
/// `displacement` is not null, a displacement map of `side²` bytes: the signed distance along the
/// normal, 0 and 255 at ∓`maximum_distance`.
ck_status ck_atlas_bake(const ck_atlas* atlas, const ck_bake_source* source,
                        const ck_control* control, uint8_t* rgb, uint8_t* displacement);

/// Bakes ambient occlusion as `side²` bytes: the cosine-weighted fraction of the hemisphere above
/// each texel that the dense surface does not occlude within `maximum_distance`; 255 is unoccluded.
/// Texels share rays with the surrounding ones, 16 × `rays_per_texel` in total.
ck_status ck_atlas_occlusion(const ck_atlas* atlas, const ck_bake_source* source,
                             size_t rays_per_texel, float maximum_distance,
                             const ck_control* control, uint8_t* gray);

#ifdef __cplusplus
}
#endif
#endif
