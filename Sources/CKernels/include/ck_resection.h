#ifndef CK_RESECTION_H
#define CK_RESECTION_H

#include "ck_camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Solves the perspective-three-point problem (Persson and Nordberg, "Lambda Twist", ECCV 2018).
///
/// `rays` are three vectors (x, y, z) of any length in the camera frame, `points` three points in
/// the world. `poses` holds at least four elements. Degenerate input gives no pose.
ck_status ck_p3p(ck_pose* poses, size_t* pose_count, const double* rays, const double* points);

/// Options of pose estimation.
typedef struct {
  /// Largest reprojection error of an inlier, in pixels.
  double maximum_error;
  /// Largest number of hypotheses to draw.
  int32_t maximum_iterations;
  /// Stops when the best hypothesis is the best of all with this probability, 0…1.
  double confidence;
  /// Fewer inliers return `ck_degenerate`.
  int32_t minimum_inliers;
  /// Random seed; the same seed gives the same pose.
  uint64_t seed;
} ck_resection_options;

/// Estimates the pose of a photo from 2D–3D correspondences (LO-RANSAC on P3P, scored by the
/// truncated squared reprojection error).
///
/// `pixels` are pairs x, y without padding, `points` start every `point_stride` bytes. `inliers`
/// holds `count` bytes that are set to 1 or 0.
ck_status ck_resect(ck_pose* pose, uint8_t* inliers, size_t* inlier_count, const double* pixels,
                    const double* points, size_t point_stride, size_t count,
                    const ck_camera_model* camera, const ck_resection_options* options,
                    const ck_control* control);

#ifdef __cplusplus
}
#endif
#endif
