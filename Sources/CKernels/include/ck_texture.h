#ifndef CK_TEXTURE_H
#define CK_TEXTURE_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

// Positions and normals are three floats every `stride` bytes. Triangles are three vertex indices
// of 12 bytes, counter-clockwise seen from outside. Texels and pixels have their origin at the
// corner of the top-left one, y down.

/// A surface made ready for ray casting. Immutable; may be used from several threads.
typedef struct ck_ray_scene ck_ray_scene;

/// Makes a surface ready for ray casting; it keeps copies of the arrays. Free with
/// `ck_ray_scene_free`.
ck_status ck_ray_scene_create(const float* positions, size_t position_count, size_t position_stride,
                              const uint32_t* triangles, size_t triangle_count,
                              const ck_control* control, ck_ray_scene** scene);

/// Frees the scene; null does nothing.
void ck_ray_scene_free(ck_ray_scene* scene);

/// A photo without lens distortion: `pixel = focal * (x, y) / z + center` of the point
/// `rotation * world + translation`; the rotation is row by row.
typedef struct {
  double focal[2];
  double center[2];
  double rotation[9];
  double translation[3];
  int32_t width;
  int32_t height;
} ck_pinhole;

/// What one view shows of one triangle.
typedef struct {
  /// Pixels that the triangle covers; 0 when the view does not see all of it.
  float area;
  /// Cosine of the angle between the triangle's normal and the direction to the camera.
  float cosine;
  /// Mean length of the luminance gradient in the triangle, 0…255 a pixel.
  float gradient;
  /// 1, or 0 where the rim of something in front of the triangle is within the margin: an error of
  /// the camera or the surface would take that thing's colour.
  float clearance;
  /// 1, or 0 where the surface ends within the margin and something far behind it, or nothing,
  /// begins, or where the mask ends: the same error would take the background's colour.
  float interior;
  /// Mean colour, 0…255.
  float color[3];
} ck_face_observation;

/// When a view sees a triangle.
typedef struct {
  /// Triangles seen at a smaller cosine count as not seen.
  float minimum_cosine;
  /// Pixels that a triangle keeps from the rim of the image; see `clearance` and `interior` too.
  float margin;
} ck_observe_options;

/// Finds which triangles of the scene a view sees whole, and how. `rgb` has 3 bytes a pixel,
/// `observations` holds one entry for every triangle of the scene. `mask` is null, or has a byte a
/// pixel: a view doesn't see triangles that reach to where it is below 128.
ck_status ck_observe_faces(const ck_ray_scene* scene, const ck_pinhole* view, const uint8_t* rgb,
                           const uint8_t* mask, const ck_observe_options* options,
                           const ck_control* control, ck_face_observation* observations);

/// Chooses one of its candidates for every node, so that the sum of the nodes' costs and of the
/// weights of edges between different labels is small: a Potts model, minimised by sequential
/// tree-reweighted message passing (Kolmogorov, PAMI 2006).
///
/// Node i has the candidates `offsets[i]..<offsets[i + 1]` of `labels` (ascending) and `costs`;
/// `edges` are pairs of nodes. `choices` receives the index of the candidate, −1 for nodes without.
ck_status ck_select_labels(size_t node_count, const uint32_t* offsets, const int32_t* labels,
                           const float* costs, size_t edge_count, const uint32_t* edges,
                           const float* edge_weights, size_t iterations, const ck_control* control,
                           int32_t* choices);

/// Solves a sparse symmetric positive definite system for several right sides by conjugate
/// gradients. Entries of the lower triangle and the diagonal; equal positions are added.
/// `values` holds `size × channels` numbers, row by row: the right sides on entry, the start
/// being zero, the solution on return.
ck_status ck_solve_sparse(size_t size, size_t channels, size_t entry_count, const uint32_t* rows,
                          const uint32_t* columns, const double* entries, double tolerance,
                          size_t iterations, const ck_control* control, double* values);

/// How large charts grow.
typedef struct {
  /// Half the opening of the cone that holds all normals of a chart, in radians, below π/2.
  float maximum_angle;
  /// Charts with a smaller share of the surface's area are joined to a neighbour where that does
  /// not fold them.
  float minimum_share;
} ck_chart_options;

/// Groups triangles into connected, compact charts that can be projected onto a plane without
/// folding: hierarchical face clustering (Garland et al., I3D 2001) on cones of normals, then
/// shorter borders by moving what lies along them (after Karypis and Kumar, SIAM J. Sci. Comput.
/// 1998).
///
/// `charts` receives a chart for every triangle, dense from 0; `axes` three floats a chart, the
/// unit direction to project along, for at most as many charts as there are triangles.
ck_status ck_cluster_faces(const float* positions, size_t position_count, size_t position_stride,
                           const uint32_t* triangles, size_t triangle_count,
                           const ck_chart_options* options, const ck_control* control,
                           int32_t* charts, float* axes, size_t* chart_count);

/// Where the packer put a chart: `texel = scale · R(quarter_turns) · plane + offset`.
typedef struct {
  float scale;
  /// Turns by 90° from x to y.
  int32_t quarter_turns;
  float offset[2];
  /// The atlas that holds the chart.
  int32_t atlas;
} ck_chart_placement;

/// The atlases to pack charts into.
typedef struct {
  /// Side of the square atlases in texels.
  int32_t side;
  int32_t atlas_count;
  /// Empty texels between charts; half as many along the border, as a texture may repeat.
  int32_t padding;
  /// Upper bound of the texels a unit of length.
  float maximum_scale;
} ck_pack_options;

/// Packs charts into squares at the largest common scale that fits; by their shape, not by their
/// bounding box. `corners` are the plane coordinates of each triangle's three corners (6 floats);
/// `density` scales each chart relative to the others (1: the common scale).
ck_status ck_pack_charts(const float* corners, const int32_t* charts, size_t triangle_count,
                         const float* density, size_t chart_count, const ck_pack_options* options,
                         const ck_control* control, ck_chart_placement* placements);

/// A texture in the making: which triangle every texel belongs to, and its colour.
typedef struct ck_atlas ck_atlas;

/// `corners` are the texel coordinates of each triangle's three corners (6 floats). Texels up to
/// `gutter` outside of a chart belong to its rim, so that interpolation across it finds colour.
ck_status ck_atlas_create(const ck_ray_scene* scene, const float* corners, size_t triangle_count,
                          int32_t side, int32_t gutter, const ck_control* control,
                          ck_atlas** atlas);

/// Frees the atlas; null does nothing.
void ck_atlas_free(ck_atlas* atlas);

/// Texels whose centre lies in a triangle, without the gutter.
size_t ck_atlas_covered_count(const ck_atlas* atlas);

/// Texels that more than one triangle claims.
size_t ck_atlas_overlap_count(const ck_atlas* atlas);

/// How much of a view goes into a triangle: at each of its corners a weight, and a colour that is
/// added to the photo's. The weights of a corner over all views add up to 1.
typedef struct {
  uint32_t face;
  float weights[3];
  float offsets[9];
} ck_paint;

/// Adds a view's colours, times `gain` a channel. Without `rgb` the offsets alone are painted.
ck_status ck_atlas_paint(ck_atlas* atlas, const ck_pinhole* view, const uint8_t* rgb,
                         const float* gain, const ck_paint* paints, size_t paint_count,
                         const ck_control* control);

/// Writes `side² × 3` bytes, the space between the charts filled from their rims.
ck_status ck_atlas_copy_colors(const ck_atlas* atlas, const ck_control* control, uint8_t* rgb);

/// What the maps that compare two surfaces need to know.
typedef struct {
  /// How far from the simplified surface the dense one is looked for, in world units.
  float maximum_distance;
  /// 9 floats a triangle: unit normals at its corners.
  const float* corner_normals;
  /// 12 floats a triangle: at each corner the unit tangent (along u) and the sign of the bitangent.
  const float* corner_tangents;
  const ck_ray_scene* dense;
  /// One normal for each position of `dense`.
  const float* dense_normals;
  size_t dense_normals_stride;
} ck_bake_source;

/// Writes `side² × 3` bytes: the dense surface's normals in the tangent frame of the simplified
/// one, flat where there is no dense surface; and when `displacement` isn't null `side²` bytes: the
/// signed distance along the normal, 0 and 255 at ∓`maximum_distance`.
ck_status ck_atlas_bake(const ck_atlas* atlas, const ck_bake_source* source,
                        const ck_control* control, uint8_t* rgb, uint8_t* displacement);

/// Writes `side²` bytes: the share of the sky, cosine-weighted, that the dense surface leaves open
/// above each texel within `maximum_distance`; 255 is all of it. Texels share rays with those
/// around them, 16 times `rays_per_texel` in all.
ck_status ck_atlas_occlusion(const ck_atlas* atlas, const ck_bake_source* source,
                             size_t rays_per_texel, float maximum_distance,
                             const ck_control* control, uint8_t* gray);

/// Collapses edges by quadric error (Garland and Heckbert, SIGGRAPH 1997) until `maximum_count`
/// triangles are left, then fits the vertices to the surface before (after Hoppe et al., SIGGRAPH
/// 1993). Keeps the surface's topology and never folds it; so it can stop early.
///
/// The first `*position_count` positions of `positions` are moved and compacted in place, so are
/// the first `*triangle_count` triangles.
ck_status ck_simplify(float* positions, size_t* position_count, size_t position_stride,
                      uint32_t* triangles, size_t* triangle_count, size_t maximum_count,
                      const ck_control* control);

#ifdef __cplusplus
}
#endif
#endif
