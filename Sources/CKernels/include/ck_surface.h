#ifndef CK_SURFACE_H
#define CK_SURFACE_H

#include "ck_core.h"
#include "ck_texture.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A triangle mesh of unknown size that a kernel made. Free with `ck_surface_free`.
typedef struct ck_surface ck_surface;

/// How fine the surface is.
typedef struct {
  /// The finest cells have a side of `scale × extent / 2^depth`.
  int32_t depth;
  /// Side of the cube that is solved in, in units of the points' largest extent.
  double scale;
} ck_poisson_options;

/// Screened Poisson surface (Kazhdan and Hoppe, ACM TOG 2013) of oriented points.
///
/// Positions and normals are three floats every `stride` bytes. Runs on one thread of its own, as
/// more of them make results that differ from run to run; a cancelled call returns at once and
/// leaves that thread to its end. Triangles are counter-clockwise seen from where normals point.
ck_status ck_poisson(const float* positions, const float* normals, size_t stride, size_t count,
                     const ck_poisson_options* options, const ck_control* control,
                     ck_surface** surface);

/// How many vertices the mesh has.
size_t ck_surface_vertex_count(const ck_surface* surface);
/// How many triangles the mesh has.
size_t ck_surface_triangle_count(const ck_surface* surface);
/// Copies the positions (three floats every `stride` bytes), the depth of the octree that the
/// samples around each vertex support (one float a vertex), and three indices a triangle.
void ck_surface_copy(const ck_surface* surface, float* positions, size_t stride, float* densities,
                     uint32_t* triangles);
/// Frees the mesh; null does nothing.
void ck_surface_free(ck_surface* surface);

/// Sorts points into the cells of a cubic grid and joins occupied cells that touch (26 neighbours).
///
/// A point of level l falls into a grid of `cell_size × 2^l`; `levels` may be null (all 0), and
/// only cells of one level are neighbours. `cells` receives each point's cell, numbered in
/// lexicographic order of (level, x, y, z); `components` (may be null) each point's component,
/// numbered by their first cell. Points that are not finite get −1 in both.
ck_status ck_voxel_cells(const float* positions, size_t stride, size_t count, double cell_size,
                         const int8_t* levels, const ck_control* control, int32_t* cells,
                         size_t* cell_count, int32_t* components, size_t* component_count);

/// Finds for every query the nearest `neighbours` points within `maximum_distance`.
///
/// `indices` and `distances` hold `neighbours` elements a query, the nearest first; −1 and infinity
/// where there are fewer.
ck_status ck_nearest_points(const float* points, size_t point_stride, size_t point_count,
                            const float* queries, size_t query_stride, size_t query_count,
                            int32_t neighbours, double maximum_distance, const ck_control* control,
                            int32_t* indices, float* distances);

/// A box of cubic cells, axis-aligned; x runs fastest.
typedef struct {
  /// The corner with the least coordinates.
  double origin[3];
  double cell_size;
  /// Cells along x, y and z, at most 4096 each.
  int32_t size[3];
} ck_free_space_grid;

/// Counts for every cell the photos that look through it at a point behind it, up to 255.
///
/// `photo_offsets` (`point_count + 1`) and `photos` name the photos that see each point, `centers`
/// holds three floats a photo. A ray ends `clearances[point]` before its point. Points and centres
/// may lie outside the grid.
ck_status ck_free_space(const ck_free_space_grid* grid, const float* points, size_t point_stride,
                        const float* clearances, size_t point_count, const uint32_t* photo_offsets,
                        const uint16_t* photos, const float* centers, size_t photo_count,
                        const ck_control* control, uint8_t* counts);

/// A surface that is being fitted to the photos.
typedef struct ck_photo_refinement ck_photo_refinement;

/// How a surface is fitted to the photos.
typedef struct {
  /// Times that photos are compared and vertices moved.
  int32_t rounds;
  /// Views that each view is compared with, at most.
  int32_t neighbours;
  /// Photos are compared by what stands out from windows of `2 × radius + 1` pixels a side.
  int32_t radius;
  /// Standard deviation of luminance, 0…255, below which a window has no texture.
  float noise;
  /// Windows with a smaller correlation show something else.
  float minimum_correlation;
  /// Weight of smoothness against the photos.
  float smoothness;
} ck_photo_refinement_options;

/// Begins to fit a mesh to photos; it keeps copies of the arrays. Positions are three floats every
/// `stride` bytes. Free with `ck_photo_refinement_free`.
ck_status ck_photo_refinement_create(const float* positions, size_t stride, size_t position_count,
                                     const uint32_t* triangles, size_t triangle_count,
                                     const ck_photo_refinement_options* options,
                                     const ck_control* control, ck_photo_refinement** refinement);

/// Adds a photo. `rgb` has 3 bytes a pixel; `mask` is null, or has a byte a pixel: where it is
/// below 128 the photo isn't compared. Keeps two bytes a pixel.
ck_status ck_photo_refinement_add(ck_photo_refinement* refinement, const ck_pinhole* view,
                                  const uint8_t* rgb, const uint8_t* mask,
                                  const ck_control* control);

/// Moves vertices along their normals to where the photos that see them agree (after Vu et al.,
/// PAMI 2012). Vertices at borders, and those without texture that two photos see, stay.
///
/// `positions` receives three floats every `stride` bytes, `moved` (may be null) the number of
/// vertices that the photos determine.
ck_status ck_photo_refinement_run(ck_photo_refinement* refinement, const ck_control* control,
                                  float* positions, size_t stride, size_t* moved);

/// Frees the refinement; null does nothing.
void ck_photo_refinement_free(ck_photo_refinement* refinement);

#ifdef __cplusplus
}
#endif
#endif
