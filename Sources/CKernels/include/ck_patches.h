#ifndef CK_PATCHES_H
#define CK_PATCHES_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A photo without distortion and its pinhole camera.
typedef struct {
  int32_t width, height;
  /// `width × height` bytes, top row first.
  const uint8_t* luma;
  /// Pixels; the origin is the corner of the top-left pixel.
  double fx, fy, cx, cy;
  /// `cameraFromWorld`: rotation by rows, then translation. x right, y down, z forward.
  double rotation[9];
  double translation[3];
  /// Standard deviation of the luma's noise in grey levels.
  float noise;
} ck_patch_view;

/// Averages 2 × 2 pixels of `width × height` bytes; `result` holds `(width / 2) × (height / 2)`.
void ck_patches_halve(uint8_t* result, const uint8_t* luma, int32_t width, int32_t height);

/// Estimates the standard deviation of the noise of `width × height` bytes in grey levels, from
/// what differs from a smooth surface in the smoothest parts (after Immerkær, CVIU 1996); at least
/// that of rounding.
float ck_patches_noise(const uint8_t* luma, int32_t width, int32_t height);

/// A sparse point in a reference view: pixel and inverse depth.
typedef struct {
  float x, y, inverse_depth;
} ck_patch_seed;

/// The patch of one pixel: a plane as its inverse depth at the pixel's centre and the gradient of
/// the inverse depth over the pixel grid. An inverse depth of 0 means that there is no patch.
typedef struct {
  float inverse_depth, gradient_x, gradient_y;
  /// 1 − ZNCC, the mean of the best two sources; 2 where there is no patch. From 0.4 where texture
  /// is so weak that the patch is that of a coarser level.
  float cost;
} ck_patch;

/// How the patches of a view are made.
typedef struct {
  /// Resolutions, each half of the next.
  int32_t level_count;
  /// Sweeps of expansion at the coarsest level; one at the others.
  int32_t coarse_sweeps;
  /// Random planes tried around the current one at the coarsest level.
  int32_t perturbations;
  /// Gauss–Newton steps.
  int32_t refinement_steps;
  /// Grey levels at which the bilateral weight is one half.
  float bilateral_contrast;
  /// Views offer each other their patches.
  int32_t expands_across_views;
  /// Patches face the camera instead of following the surface.
  int32_t is_frontal;
  /// The same seed gives the same patches.
  uint32_t seed;
  /// Of the inner loops. Results differ by rounding only.
  ck_instructions instructions;
} ck_patch_options;

/// Makes the patches of one reference view, coarse to fine (Furukawa and Ponce, PAMI 2010, with the
/// plane per pixel of Bleyer et al., BMVC 2011).
///
/// `sources` are at most 8 views, the best first. `patches` holds `width × height` values of the
/// reference. Runs on one thread: call it for several views at once.
ck_status ck_patches_reconstruct(ck_patch* patches, const ck_patch_view* reference,
                                 const ck_patch_view* sources, size_t source_count,
                                 const ck_patch_seed* seeds, size_t seed_count,
                                 const ck_patch_options* options, const ck_control* control);

/// The patches of one view.
typedef struct {
  /// Tells views apart, at most 65535.
  int32_t photo;
  ck_patch_view view;
  /// RGB of the view.
  const uint8_t* rgb;
  const ck_patch* patches;
  /// What the filter said of each patch; may be null where only patches are asked for.
  const uint8_t* states;
  /// The neighbours that agree with each patch, a bit each in the filter's order; may be null.
  const uint8_t* visibility;
} ck_patch_map;

/// Makes the patches of one reference view from its patches at half the resolution.
///
/// `coarse` are filtered patches of the reference that `ck_patches_halve` halved, with half its
/// focal lengths and principal point; its neighbours were the halved `sources`, in the same order.
/// Each patch is compared with the sources that agree with the coarse ones around (its visible
/// photos, Furukawa and Ponce, PAMI 2010, section 3.1). `patches` holds `width × height` values.
ck_status ck_patches_refine(ck_patch* patches, const ck_patch_view* reference,
                            const ck_patch_view* sources, size_t source_count,
                            const ck_patch_map* coarse, const ck_patch_options* options,
                            const ck_control* control);

/// Which patches are kept and how they are joined.
typedef struct {
  /// Largest cost of a patch that `minimum_agreeing` views may confirm.
  float photometric_threshold;
  /// Largest cost of a patch; between the two thresholds one more view must agree.
  float weak_texture_threshold;
  /// Other views that must agree; all but one where there are fewer, but always one.
  int32_t minimum_agreeing;
  /// Pixels of disparity between a patch and its confirmation, in the coarser view.
  float reprojection_threshold;
  /// Relative difference of depth.
  float depth_threshold;
  /// Cosine of the largest angle between normals.
  float normal_cosine;
  /// Patches that another view sees through are removed beyond this relative distance.
  float contradiction_threshold;
  /// How often pixels that look like their rejected neighbours are peeled off the border.
  int32_t fringe_passes;
  /// Grey levels that make a pixel half like another.
  float fringe_contrast;
  /// Connected patches fewer than this are removed.
  int32_t minimum_island;
  /// Pixels within which confirmations are fused.
  float fusion_threshold;
  /// Of the inner loops. Results differ by rounding only.
  ck_instructions instructions;
} ck_patch_filter_options;

/// Marks the patches of `reference` that enough of its neighbours confirm and no more contradict.
///
/// The state of a rejected patch is 0, that of an accepted one the logarithm of its footprint, so
/// that views tell which of them shows a piece of surface finest. `states` holds `width × height`
/// bytes, and `visibility` as many, or is null; `neighbors` are the views that may confirm, the
/// best first. Runs on one thread: call it for several views at once.
ck_status ck_patches_filter(uint8_t* states, uint8_t* visibility, const ck_patch_map* reference,
                            const ck_patch_map* neighbors, size_t neighbor_count,
                            const ck_patch_filter_options* options, const ck_control* control);

/// Expands patches across views and into holes: offers the accepted patches of the neighbours, and
/// those beside a cell, to the cells of `reference` that the filter rejected, and optimises what is
/// better than what they had (Furukawa and Ponce, PAMI 2010, section 3.2). Near edges of the
/// surface patches are made anew, of the texels that lie on their side of the edge by the patches
/// there. In the end patches are averaged with those around, the more the less texture says.
///
/// All maps have states; `completed` holds `width × height` patches, for the filter to judge. Runs
/// on one thread.
ck_status ck_patches_complete(ck_patch* completed, const ck_patch_map* reference,
                              const ck_patch_map* neighbors, size_t neighbor_count,
                              const ck_patch_options* options, const ck_control* control);

/// A fused patch.
typedef struct {
  float position[3];
  float normal[3];
  uint8_t color[3];
  uint8_t photo_count;
  /// Mean ZNCC of the fused patches.
  float consistency;
  /// Side of a pixel of the reference at the patch, in world units.
  float footprint;
  /// Photos that agree, ascending.
  uint16_t photos[16];
} ck_fused_patch;

/// Fuses the accepted patches of `reference` with those of its neighbours that agree with them.
///
/// A piece of surface that several views show becomes a point of the view that shows it finest, of
/// the lowest photo among equals: each view tells which points are its own, so that views are fused
/// in any order, or at once. `fused` has room for as many patches as the view has accepted. Runs on
/// one thread.
ck_status ck_patches_fuse(ck_fused_patch* fused, size_t* fused_count, const ck_patch_map* reference,
                          const ck_patch_map* neighbors, size_t neighbor_count,
                          const ck_patch_filter_options* options, const ck_control* control);

#ifdef __cplusplus
}
#endif
#endif
