#ifndef CK_PATCHES_H
#define CK_PATCHES_H

#include "ck_camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An undistorted photo with its camera, pose and luma, as input of patch stereo. The camera's
/// distortion is ignored.
typedef struct {
  ck_camera camera;
  ck_pose camera_from_world;
  /// One byte per pixel, top row first, without padding.
  const uint8_t* luma;
  /// Standard deviation of the luma noise, in gray levels (0…255).
  float noise;
} ck_patch_view;

/// Halves a `width × height` luma image by averaging 2 × 2 pixels; `result` holds `(width / 2) ×
/// (height / 2)` bytes.
void ck_patches_halve(const uint8_t* luma, int32_t width, int32_t height, uint8_t* result);

/// Estimates the standard deviation of the noise of a `width × height` luma image in gray levels,
/// from the deviation from a smooth surface in its smoothest parts (after Immerkær, CVIU 1996); at
/// least the standard deviation of rounding.
float ck_patches_noise(const uint8_t* luma, int32_t width, int32_t height);

/// A sparse point in a reference view: pixel position, and inverse depth 1 / z in the camera frame.
typedef struct {
  float x, y, inverse_depth;
} ck_patch_seed;

/// The patch of one pixel: a plane, given by its inverse depth at the pixel center and the gradient
/// of the inverse depth over the pixel grid (per pixel). An inverse depth of 0 means that there is
/// no patch.
typedef struct {
  float inverse_depth, gradient_x, gradient_y;
  /// 1 − ZNCC, averaged over the two best sources; 2 where there is no patch. At least 0.4 where
  /// texture is so weak that the patch was inherited from a coarser level.
  float cost;
} ck_patch;

/// Options of patch reconstruction.
typedef struct {
  /// Number of pyramid levels; each has half the resolution of the next finer one.
  int32_t level_count;
  /// Number of propagation sweeps at the coarsest level; the finer levels have one.
  int32_t coarse_sweeps;
  /// Number of random perturbations of the current plane to test at the coarsest level.
  int32_t perturbations;
  /// Number of Gauss–Newton steps.
  int32_t refinement_steps;
  /// Difference in gray levels at which the bilateral weight is one half.
  float bilateral_contrast;
  /// True to propagate patches across views.
  bool expands_across_views;
  /// True for fronto-parallel patches instead of slanted ones.
  bool is_fronto_parallel;
  /// Random seed; the same seed gives the same patches.
  uint32_t seed;
  /// Instruction set of the inner loops. Results differ by rounding only.
  ck_instructions instructions;
} ck_patch_options;

/// Reconstructs the patches of one reference view, coarse to fine (Furukawa and Ponce, PAMI 2010,
/// with one plane per pixel as in Bleyer et al., BMVC 2011).
///
/// `sources` are 1 to 8 views, the best first. `patches` holds `width × height` values of the
/// reference. Returns `ck_degenerate` if no seed has a positive inverse depth. Runs on one thread;
/// may be called for several views at once.
ck_status ck_patches_reconstruct(const ck_patch_view* reference, const ck_patch_view* sources,
                                 size_t source_count, const ck_patch_seed* seeds, size_t seed_count,
                                 const ck_patch_options* options, const ck_control* control,
                                 ck_patch* patches);

/// The patches of one view.
typedef struct {
  /// Unique identifier of the view, 0…65535.
  int32_t photo;
  ck_patch_view view;
  /// RGB of the view; null for views without color, whose fused points are then black.
  const uint8_t* rgb;
  const ck_patch* patches;
  /// Filter result of each patch (`ck_patches_filter`): 0 if rejected; may be null for functions
  /// that need only the patches.
  const uint8_t* states;
  /// Bit mask of the neighbors that are consistent with each patch, in the order given to the
  /// filter; may be null.
  const uint8_t* visibility;
} ck_patch_map;

/// Reconstructs the patches of one reference view from its patches at half the resolution.
///
/// `coarse` holds the filtered patches of the reference halved by `ck_patches_halve`, with half its
/// focal lengths and principal point; its neighbors were the halved `sources`, in the same order.
/// Each patch is compared with the sources that are consistent with the surrounding coarse patches
/// (its visibility; Furukawa and Ponce, PAMI 2010, section 3.1). `patches` holds `width × height`
/// values.
ck_status ck_patches_refine(const ck_patch_view* reference, const ck_patch_view* sources,
                            size_t source_count, const ck_patch_map* coarse,
                            const ck_patch_options* options, const ck_control* control,
                            ck_patch* patches);

/// Thresholds of the patch filter and of fusion.
typedef struct {
  /// Largest cost of a patch for which `minimum_consistent_views` consistent views suffice.
  float photometric_threshold;
  /// Largest cost of any patch; between the two thresholds one more consistent view is required.
  float weak_texture_threshold;
  /// Number of other views that must be consistent; all but one if there are fewer, but at least
  /// one.
  int32_t minimum_consistent_views;
  /// Largest disparity between two consistent patches, in pixels of the coarser view.
  float reprojection_threshold;
  /// Largest relative difference in depth of two consistent patches.
  float depth_threshold;
  /// Cosine of the largest angle between the normals of two consistent patches.
  float normal_cosine;
  /// Relative depth difference from which another view that sees past a patch counts as a
  /// free-space violation.
  float free_space_threshold;
  /// Number of passes that remove boundary pixels affected by foreground fattening.
  int32_t depth_edge_passes;
  /// Difference in gray levels at which the similarity of two pixels is one half.
  float depth_edge_contrast;
  /// Connected components with fewer patches are removed.
  int32_t minimum_island_size;
  /// Largest disparity at which consistent patches are fused, in pixels of the coarser view.
  float fusion_threshold;
  /// Instruction set of the inner loops. Results differ by rounding only.
  ck_instructions instructions;
} ck_patch_filter_options;

/// Marks the patches of `reference` that enough neighbors confirm and not too many contradict
/// (geometric consistency).
///
/// The state of a rejected patch is 0, that of an accepted one the logarithm of its footprint,
/// which determines the view that resolves a surface element best. `states` holds `width × height`
/// bytes, and so does `visibility` unless it is null; `neighbors` are the views to compare with,
/// the best first, at most 8 if `visibility` is not null. Runs on one thread; may be called for
/// several views at once.
ck_status ck_patches_filter(const ck_patch_map* reference, const ck_patch_map* neighbors,
                            size_t neighbor_count, const ck_patch_filter_options* options,
                            const ck_control* control, uint8_t* states, uint8_t* visibility);

/// Propagates patches across views and into holes: tests the accepted patches of the neighbors, and
/// those of adjacent cells, at the cells of `reference` that the filter rejected, and optimizes
/// those that improve the cost (Furukawa and Ponce, PAMI 2010, section 3.2). Patches near depth
/// discontinuities are re-estimated from the texels on their side of the edge, as determined by the
/// surrounding patches. Finally patches are smoothed; the weaker the texture, the stronger the
/// smoothing.
///
/// There are at most 8 neighbors, and all maps have states; `completed` holds `width × height`
/// patches, which have to be filtered again. Runs on one thread.
ck_status ck_patches_complete(const ck_patch_map* reference, const ck_patch_map* neighbors,
                              size_t neighbor_count, const ck_patch_options* options,
                              const ck_control* control, ck_patch* completed);

/// A fused patch.
typedef struct {
  /// World frame.
  float position[3];
  /// Unit vector in the world frame, toward the photos.
  float normal[3];
  /// RGB.
  uint8_t color[3];
  /// Number of elements of `photos` that are set.
  uint8_t photo_count;
  /// Mean ZNCC of the patches that were fused.
  float consistency;
  /// Side of a reference pixel at the depth of the patch, in world units.
  float footprint;
  /// Identifiers of the photos that are consistent with the patch, ascending; the first 16.
  uint16_t photos[16];
} ck_fused_patch;

/// Fuses the accepted patches of `reference` with the consistent patches of its neighbors.
///
/// A surface element seen by several views becomes a point of the view with the smallest footprint,
/// on a tie of the lowest photo. Each view determines its points independently, so views can be
/// fused in any order, or concurrently. `fused` has room for `capacity` points; the number of
/// accepted patches of the view is sufficient, and with too few the call fails with
/// `ck_invalid_argument`. Runs on one thread.
ck_status ck_patches_fuse(const ck_patch_map* reference, const ck_patch_map* neighbors,
                          size_t neighbor_count, const ck_patch_filter_options* options,
                          const ck_control* control, ck_fused_patch* fused, size_t capacity,
                          size_t* fused_count);

#ifdef __cplusplus
}
#endif
#endif
