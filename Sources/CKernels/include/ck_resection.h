#ifndef CK_RESECTION_H
#define CK_RESECTION_H

#include "ck_camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Solves the perspective-three-point problem (Persson and Nordberg, "Lambda Twist", ECCV 2018).
///
/// `rays` are three vectors (x, y, z) of any length in the camera frame, `points` three points in
/// the world. `poses` has room for four elements and receives `cameraFromWorld`. Degenerate input
/// gives no pose.
ck_status ck_p3p(const double* rays, const double* points, ck_pose* poses, size_t* pose_count);

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
/// `pixels` (2 doubles) and `points` (3 doubles, world frame) have the same count. `inliers` holds
/// as many bytes, which are set to 1 or 0. Returns `ck_degenerate` for fewer than four points, and
/// if no pose has enough inliers.
ck_status ck_resect(const ck_camera* camera, ck_span pixels, ck_span points,
                    const ck_resection_options* options, const ck_control* control, ck_pose* pose,
                    uint8_t* inliers, size_t* inlier_count);

#ifdef __cplusplus
}
#endif
#endif
