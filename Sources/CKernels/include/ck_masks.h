#ifndef CK_MASKS_H
#define CK_MASKS_H

#include "ck_camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Points that are drawn as discs parallel to the image plane.
typedef struct {
  /// 3 floats, world frame.
  ck_span positions;
  /// Radius of each disc in world units.
  const float* radii;
  /// What each disc is drawn as, above 0.
  const uint8_t* labels;
} ck_discs;

/// Draws discs into a photo with a depth buffer (surface splatting): each pixel receives the label
/// of the nearest disc that covers its center, 0 where there is none.
///
/// Every disc covers at least one pixel center. `labels` is gray and has the size of
/// the camera.
ck_status ck_draw_discs(const ck_discs* discs, const ck_camera* camera, const ck_pose* pose,
                        const ck_control* control, const ck_mutable_pixels* labels);

/// Counts for every point whether a photo has it in its frame, and whether its mask contains it:
/// increments `seen` and `inside`, one number per point.
///
/// `points` are 3 floats in the world frame. `mask` is gray, 128 or more on the object, and has the
/// size of the camera.
ck_status ck_count_mask_hits(ck_span points, const ck_camera* camera, const ck_pose* pose,
                             const ck_pixels* mask, uint16_t* seen, uint16_t* inside);

/// Options of an image cut.
typedef struct {
  /// Cost of a cut between two adjacent pixels of equal color, in units of log-odds. It decreases
  /// with the contrast.
  float smoothness;
  /// Pixels with log-odds of at least this magnitude keep their sign.
  float certainty;
} ck_cut_options;

/// Divides a photo into object and surroundings by a minimum cut (Boykov and Jolly, "Interactive
/// Graph Cuts for Optimal Boundary & Region Segmentation of Objects in N-D Images", ICCV 2001).
///
/// `log_odds` holds one number per pixel, positive on the object. Pixels are connected to their
/// eight neighbors with weights that decrease with their contrast relative to that of the whole
/// image. `image` is RGB; `mask` is gray, of the same size, and receives 255 on the object and 0
/// elsewhere.
ck_status ck_cut_image(const ck_pixels* image, const float* log_odds, const ck_cut_options* options,
                       const ck_control* control, const ck_mutable_pixels* mask);

#ifdef __cplusplus
}
#endif
#endif
