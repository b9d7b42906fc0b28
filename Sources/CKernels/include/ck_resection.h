#ifndef CK_RESECTION_H
#define CK_RESECTION_H

#include "ck_camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Finds all poses that see three points along three rays (Persson and Nordberg, "Lambda Twist",
/// ECCV 2018).
///
/// `rays` are three vectors (x, y, z) in the camera frame of any length, `points` three points in
/// the world. `poses` holds at least four. Degenerate input gives no pose.
ck_status ck_p3p(ck_pose* poses, size_t* pose_count, const double* rays, const double* points);

/// How a pose is searched for.
typedef struct {
  /// Largest reprojection error of an inlier in pixels.
  double max_error;
  /// Hypotheses drawn at most.
  int32_t max_iterations;
  /// Stops when the best hypothesis is the best of all with this probability, 0…1.
  double confidence;
  /// Fewer inliers are `ck_degenerate`.
  int32_t minimum_inliers;
  /// The same seed gives the same pose.
  uint64_t seed;
} ck_resection_options;

/// Finds the pose of a photo from pixels and the points that they see (LO-RANSAC on P3P with the
/// truncated squared error as score).
///
/// `pixels` are pairs x, y without padding, `points` start every `point_stride` bytes. `inliers`
/// holds `count` bytes that become 1 or 0.
ck_status ck_resect(ck_pose* pose, uint8_t* inliers, size_t* inlier_count, const double* pixels,
                    const double* points, size_t point_stride, size_t count,
                    const ck_camera_model* camera, const ck_resection_options* options,
                    const ck_control* control);

#ifdef __cplusplus
}
#endif
#endif
