#ifndef CK_SURFACE_H
#define CK_SURFACE_H

#include "ck_camera.h"
#include "ck_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A triangle mesh allocated by a kernel. Free with `ck_surface_free`.
typedef struct ck_surface ck_surface;

/// Options of Poisson reconstruction.
typedef struct {
  /// Octree depth; the smallest cells have a side of `1 / 2^depth` of the cube's.
  int32_t depth;
  /// Side of the cube in which the system is solved, relative to the largest extent of the points.
  double scale;
  /// Memory that the solver may use; the octree is less deep if it would need more.
  size_t maximum_bytes;
  /// The cube: its lowest corner and its side. With a side of 0 it is that around the points.
  double cube_origin[3];
  double cube_side;
} ck_poisson_options;

/// Cells of one level of an octree: from `low` to before `high` along x, y and z. A node belongs to
/// the cell of which it is the lowest corner.
typedef struct {
  int32_t depth;
  int32_t low[3];
  int32_t high[3];
} ck_cell_box;

/// A solved function on an octree, whose surface of one value is the reconstructed surface. Free
/// with `ck_poisson_free`.
typedef struct ck_poisson_solution ck_poisson_solution;

/// Screened Poisson surface reconstruction (Kazhdan and Hoppe, ACM TOG 2013) from oriented points,
/// with trilinear functions on an adaptive octree.
///
/// Positions and normals (3 floats) have the same count; points that are not finite, have no normal
/// or lie outside the given cube are ignored. Returns `ck_degenerate` if fewer than four points are
/// left, or if all are at one position.
ck_status ck_poisson_solve(ck_span positions, ck_span normals, const ck_poisson_options* options,
                           const ck_control* control, ck_poisson_solution** solution);

/// Solves the levels below those of `base` down to `depth` for the points of a part of the scene,
/// which need to be all points there. Otherwise like `ck_poisson_solve`, in the cube of the base.
ck_status ck_poisson_refine(const ck_poisson_solution* base, ck_span positions, ck_span normals,
                            int32_t depth, const ck_control* control,
                            ck_poisson_solution** solution);

/// Takes the values of `other` at the nodes in a box, below the levels of a common base of depth
/// `base_depth`. Two parts that have the same values at the nodes of a seam, and one node beyond
/// it, have the same surface there, to the last bit.
ck_status ck_poisson_adopt(ck_poisson_solution* solution, const ck_poisson_solution* other,
                           int32_t base_depth, const ck_cell_box* box, const ck_control* control);

/// The surface around the nodes in a box; around all with null. Surfaces of boxes that adjoin fit
/// together.
///
/// Triangles are counter-clockwise when seen from the side that the normals point to. The surface
/// has no cracks; it is open where it leaves the cube or the box.
ck_status ck_poisson_surface(const ck_poisson_solution* solution, const ck_cell_box* box,
                             const ck_control* control, ck_surface** surface);

/// Greatest depth of the octree: less than that of the options if memory does not suffice.
int32_t ck_poisson_depth(const ck_poisson_solution* solution);
/// The cube: its lowest corner (3 doubles) and its side.
void ck_poisson_cube(const ck_poisson_solution* solution, double* origin, double* side);
/// Serializes what the surface in a box depends on: calls `write` once with the bytes.
ck_status ck_poisson_encode(const ck_poisson_solution* solution, const ck_cell_box* box,
                            void (*write)(void* context, const void* bytes, size_t count),
                            void* context);
/// Restores what the surface in a box depends on from the bytes of a box that contains it. Returns
/// `ck_invalid_argument` if they are malformed.
ck_status ck_poisson_decode(const void* bytes, size_t count, const ck_cell_box* box,
                            const ck_control* control, ck_poisson_solution** solution);
/// Frees the solution; null does nothing.
void ck_poisson_free(ck_poisson_solution* solution);

/// Number of vertices of the mesh.
size_t ck_surface_vertex_count(const ck_surface* surface);
/// Number of triangles of the mesh.
size_t ck_surface_triangle_count(const ck_surface* surface);
/// Copies the positions (3 floats) and three indices per triangle.
void ck_surface_copy(const ck_surface* surface, ck_mutable_span positions, uint32_t* triangles);
/// Frees the mesh; null does nothing.
void ck_surface_free(ck_surface* surface);

/// Assigns points to the cells of a cubic grid and finds the connected components of the occupied
/// cells (26-neighborhood).
///
/// A point of level l falls into a grid with cells of `cell_size × 2^l`; `levels` may be null (all
/// 0), and only cells of the same level are neighbors. `cells` receives each point's cell, numbered
/// in lexicographic order of (level, x, y, z). With `finds_members`, `members` receives the finite
/// points by cell, ascending in each, and `starts`, with room for one more than the points, where
/// those of each cell start and the last ones end. `components` (may be null) receives each point's
/// component, numbered by their first cell. Points that are not finite get −1 in both.
ck_status ck_voxel_cells(ck_span positions, double cell_size, const int8_t* levels,
                         const ck_control* control, int32_t* cells, size_t* cell_count,
                         int32_t* members, int32_t* starts, bool finds_members, int32_t* components,
                         size_t* component_count);

/// Limits of a nearest-neighbor search.
typedef struct {
  /// Number of neighbors per query.
  int32_t neighbors;
  /// Search radius, in units of the coordinates; above 0, may be infinite.
  double maximum_distance;
} ck_nearest_options;

/// Finds the nearest `neighbors` points within `maximum_distance` of every query. Points and
/// queries are 3 floats each.
///
/// `indices` and `distances` hold `neighbors` elements per query, the nearest first; −1 and
/// infinity where there are fewer.
ck_status ck_nearest_points(ck_span points, ck_span queries, const ck_nearest_options* options,
                            const ck_control* control, int32_t* indices, float* distances);

/// Finds which of the points, 3 floats each, have at least `minimum` others within a radius of
/// their own.
///
/// `radii` holds one radius per point, in units of the coordinates, and `have_neighbors` gets 1 or
/// 0 per point; 0 for one that is not finite.
ck_status ck_have_neighbors(ck_span points, const float* radii, size_t minimum,
                            const ck_control* control, uint8_t* have_neighbors);

/// An axis-aligned grid of cubic cells; x varies fastest.
typedef struct {
  /// The corner with the smallest coordinates.
  double origin[3];
  double cell_size;
  /// Number of cells along x, y and z, at most 4096 each.
  int32_t size[3];
} ck_free_space_grid;

/// Points and the photos in which each is visible.
typedef struct {
  /// 3 floats.
  ck_span positions;
  /// Distance in front of each point at which its rays end.
  const float* clearances;
  /// Point i is visible in the photos `photos[photo_offsets[i]..<photo_offsets[i + 1]]`.
  const uint32_t* photo_offsets;
  const uint16_t* photos;
} ck_seen_points;

/// Free-space evidence: counts for every cell the photos with a ray through it to a visible point
/// behind it, up to 255. Rays are traversed cell by cell (Amanatides and Woo, Eurographics 1987).
///
/// `centers` holds the camera center of each photo (3 floats). Points and camera centers may lie
/// outside the grid. `counts` holds one byte per cell.
ck_status ck_free_space(const ck_free_space_grid* grid, const ck_seen_points* points,
                        ck_span centers, const ck_control* control, uint8_t* counts);

/// State of a photometric mesh refinement.
typedef struct ck_photo_refinement ck_photo_refinement;

/// Options of photometric mesh refinement.
typedef struct {
  /// Number of rounds of comparing photos and moving vertices.
  int32_t rounds;
  /// Largest number of views that each view is compared with.
  int32_t neighbors;
  /// Photos are compared by normalized cross-correlation in windows of `2 × radius + 1` pixels per
  /// side.
  int32_t radius;
  /// Standard deviation of luminance (0…255) below which a window has no texture.
  float noise;
  /// Windows with a smaller correlation are ignored (occlusion or mismatch).
  float minimum_correlation;
  /// Weight of the smoothness term relative to the photometric term.
  float smoothness;
} ck_photo_refinement_options;

/// Starts the refinement of a mesh; copies its arrays. Free with `ck_photo_refinement_free`.
ck_status ck_photo_refinement_create(const ck_mesh* mesh,
                                     const ck_photo_refinement_options* options,
                                     const ck_control* control, ck_photo_refinement** refinement);

/// Adds a photo. `rgb` has 3 bytes per pixel; `mask` is null, or has one byte per pixel: pixels
/// below 128 are not compared. Keeps two bytes per pixel.
ck_status ck_photo_refinement_add(ck_photo_refinement* refinement, const ck_view* view,
                                  const uint8_t* rgb, const uint8_t* mask,
                                  const ck_control* control);

/// Moves vertices along their normals to maximize photo-consistency (after Vu et al., PAMI 2012).
/// Vertices on mesh boundaries, and those without texture visible in two photos, do not move.
///
/// `positions` receives 3 floats per vertex, `moved` (may be null) the number of vertices that the
/// photos constrain.
ck_status ck_photo_refinement_run(ck_photo_refinement* refinement, const ck_control* control,
                                  ck_mutable_span positions, size_t* moved);

/// Frees the refinement; null does nothing.
void ck_photo_refinement_free(ck_photo_refinement* refinement);

#ifdef __cplusplus
}
#endif
#endif
