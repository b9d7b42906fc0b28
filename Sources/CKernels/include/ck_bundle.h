#ifndef CK_BUNDLE_H
#define CK_BUNDLE_H

#include "ck_camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/// When a track becomes a point.
typedef struct {
  /// Largest reprojection error of an inlier in pixels.
  double max_error;
  /// Smallest of the largest angles between two inlier rays, in radians.
  double min_angle;
} ck_triangulation_options;

/// Triangulates tracks: robust over pairs of rays, then least squares of the reprojection error.
///
/// Track i has the observations `offsets[i]..<offsets[i + 1]` (their `point` is not read). For each
/// track `found` becomes 1 and `positions` its point when at least two observations agree, in front
/// of their cameras and at a sufficient angle; `inliers` becomes 1 for the observations that do.
ck_status ck_triangulate(double* positions, size_t position_stride, uint8_t* found,
                         uint8_t* inliers, const int32_t* offsets, size_t track_count,
                         const ck_observation* observations, const ck_views* views,
                         const ck_triangulation_options* options, const ck_control* control);

/// Reprojection errors and triangulation angles of tracks with a known position.
///
/// `errors` holds one value an observation in pixels (infinite behind the camera), `angles` one
/// value a track: the largest angle in radians between two rays whose error is at most `max_error`.
ck_status ck_measure_tracks(double* errors, double* angles, const double* positions,
                            size_t position_stride, const int32_t* offsets, size_t track_count,
                            const ck_observation* observations, const ck_views* views,
                            double max_error, const ck_control* control);

/// The parameters of a camera that bundle adjustment may change, as bits.
typedef enum {
  ck_free_focal_length = 1,
  ck_free_k1 = 2,
  ck_free_k2 = 4,
  ck_free_principal_point = 8,
  ck_free_tangential = 16,
} ck_camera_freedom;

/// What is known of a camera beforehand: normal distributions about the given values.
///
/// A deviation of 0 means nothing is known.
typedef struct {
  double focal_length, cx, cy;
  /// Relative to the focal length.
  double focal_deviation;
  /// Pixels.
  double principal_point_deviation;
  /// Of k1 and k2 about zero.
  double radial_deviation;
} ck_camera_prior;

/// How a photo's pose takes part.
typedef enum {
  ck_pose_constant = 0,
  ck_pose_free = 1,
  /// The largest component of the translation is kept, which fixes the scale of the world.
  ck_pose_scale_fixed = 2,
} ck_pose_freedom;

/// A scene to adjust; cameras, poses and points are changed in place.
typedef struct {
  ck_camera_model* cameras;
  /// Bits of `ck_camera_freedom` for each camera.
  const uint32_t* camera_freedom;
  const ck_camera_prior* camera_priors;
  size_t camera_count;
  ck_pose* poses;
  const int32_t* photo_cameras;
  /// `ck_pose_freedom` for each photo.
  const uint8_t* pose_freedom;
  size_t photo_count;
  double* points;
  size_t point_stride;
  /// 1 for points that may move.
  const uint8_t* point_freedom;
  size_t point_count;
  const ck_observation* observations;
  size_t observation_count;
} ck_bundle;

/// How a bundle is adjusted.
typedef struct {
  int32_t max_iterations;
  /// Where the Huber loss turns from square to linear, in pixels.
  double huber_width;
  /// Stops when the relative decrease of the cost falls below this.
  double function_tolerance;
  /// Reduced camera systems of more photos are factorised sparsely.
  int32_t dense_photo_limit;
  /// Systems of more photos are solved by preconditioned conjugate gradients.
  int32_t direct_photo_limit;
} ck_bundle_options;

/// How the adjustment went.
typedef struct {
  /// Robustified cost in square pixels.
  double initial_cost, final_cost;
  int32_t iterations;
  bool converged;
} ck_bundle_summary;

/// Minimises the Huber loss of the reprojection errors (Triggs et al., "Bundle adjustment: a modern
/// synthesis", 1999) with Ceres.
///
/// fx and fy keep their ratio. Runs on one thread, so that the sums don't depend on their number.
ck_status ck_bundle_adjust(ck_bundle* bundle, ck_bundle_summary* summary,
                           const ck_bundle_options* options, const ck_control* control);

/// The reprojection error of one observation and its derivatives, as bundle adjustment uses them.
///
/// `pose_jacobian` is 2×6 (rotation vector applied from the left, translation), `point_jacobian`
/// 2×3, `camera_jacobian` 2×7 (fx with fy in proportion, cx, cy, k1, k2, p1, p2), all by rows.
ck_status ck_reprojection_jacobians(double* residual, double* pose_jacobian, double* point_jacobian,
                                    double* camera_jacobian, const ck_camera_model* camera,
                                    const ck_pose* pose, const double* point, const double* pixel);

#ifdef __cplusplus
}
#endif
#endif
