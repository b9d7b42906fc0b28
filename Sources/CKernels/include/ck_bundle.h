#ifndef CK_BUNDLE_H
#define CK_BUNDLE_H

#include "ck_camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Acceptance thresholds of triangulation.
typedef struct {
  /// Largest reprojection error of an inlier, in pixels.
  double maximum_error;
  /// Smallest triangulation angle in radians: the largest angle between two inlier rays must reach
  /// it.
  double minimum_angle;
} ck_triangulation_options;

/// Triangulates tracks: robust hypotheses from pairs of rays, then least squares on the
/// reprojection error.
///
/// For each track, `found` is set to 1 and its element of `positions` (3 doubles) to the point if
/// at least two observations agree, with the point in front of their cameras and at a sufficient
/// triangulation angle. `inliers` is set to 1 for the observations that agree, to 0 for the others.
ck_status ck_triangulate(const ck_tracks* tracks, const ck_posed_photos* photos,
                         const ck_triangulation_options* options, const ck_control* control,
                         ck_mutable_span positions, uint8_t* found, uint8_t* inliers);

/// Reprojection errors and triangulation angles of tracks with known `positions` (3 doubles).
///
/// `errors` holds one value per observation in pixels (infinite behind the camera), `angles` one
/// value per track: the largest angle in radians between two rays whose error is at most
/// `maximum_error`.
ck_status ck_measure_tracks(const ck_tracks* tracks, ck_span positions,
                            const ck_posed_photos* photos, double maximum_error,
                            const ck_control* control, double* errors, double* angles);

/// Camera parameters that bundle adjustment may change, as bits.
typedef enum {
  /// fx, and fy in proportion.
  ck_free_focal_length = 1,
  ck_free_k1 = 2,
  ck_free_k2 = 4,
  /// cx and cy.
  ck_free_principal_point = 8,
  /// p1 and p2.
  ck_free_tangential = 16,
} ck_camera_freedom;

/// Priors on camera parameters: normal distributions centered on the given values.
///
/// A standard deviation of 0 disables the prior.
typedef struct {
  /// fx and the principal point in pixels.
  double focal_length, cx, cy;
  /// Standard deviation of fx, relative to `focal_length`.
  double focal_deviation;
  /// Standard deviation of cx and of cy in pixels.
  double principal_point_deviation;
  /// Standard deviation of k1 and k2 about zero.
  double radial_deviation;
} ck_camera_prior;

/// Degrees of freedom of a photo's pose.
typedef enum {
  ck_pose_constant = 0,
  ck_pose_free = 1,
  /// The translation component that is most sensitive to the scale is held constant, which fixes
  /// the scale of the world.
  ck_pose_scale_fixed = 2,
} ck_pose_freedom;

/// A scene to adjust; cameras, poses and points are modified in place.
typedef struct {
  ck_camera* cameras;
  /// Bits of `ck_camera_freedom` for each camera.
  const uint32_t* camera_freedom;
  /// One for each camera.
  const ck_camera_prior* camera_priors;
  size_t camera_count;
  ck_pose* poses;
  /// Index into `cameras` for each photo.
  const int32_t* photo_cameras;
  /// `ck_pose_freedom` for each photo.
  const uint8_t* pose_freedom;
  size_t photo_count;
  /// World coordinates, 3 doubles each.
  ck_mutable_span points;
  /// 1 for points to optimize, 0 for constant ones.
  const uint8_t* point_freedom;
  const ck_observation* observations;
  size_t observation_count;
} ck_bundle;

/// Options of bundle adjustment.
typedef struct {
  /// Largest number of Levenberg–Marquardt iterations.
  int32_t maximum_iterations;
  /// Residual at which the Huber loss changes from quadratic to linear, in pixels.
  double huber_width;
  /// Stops when the relative decrease of the cost falls below this value.
  double function_tolerance;
  /// Reduced camera systems with more free photos than this are factorized as sparse matrices.
  int32_t dense_photo_limit;
  /// Systems whose factorization takes more multiplications than this are solved by preconditioned
  /// conjugate gradients.
  double direct_work;
} ck_bundle_options;

/// Summary of a bundle adjustment.
typedef struct {
  /// Robust cost in pixels squared.
  double initial_cost, final_cost;
  int32_t iterations;
  /// Whether the solver stopped before the largest number of iterations.
  bool converged;
} ck_bundle_summary;

/// Minimizes the Huber loss of the reprojection errors by Levenberg–Marquardt iterations in which
/// the points are eliminated (Triggs et al., "Bundle adjustment: a modern synthesis", 1999,
/// section 6.1).
///
/// The ratio of fx and fy is constant. The result does not depend on the number of threads. Returns
/// `ck_failed` if an error is not finite at the start or a camera diverges; then, and after
/// cancellation, the scene is unchanged.
ck_status ck_bundle_adjust(ck_bundle* bundle, const ck_bundle_options* options,
                           const ck_control* control, ck_bundle_summary* summary);

/// The reprojection error of one observation and its derivatives, as bundle adjustment uses them.
///
/// `pose_jacobian` is 2×6 (rotation vector applied from the left, translation), `point_jacobian`
/// 2×3, `camera_jacobian` 2×7 (fx with fy in proportion, cx, cy, k1, k2, p1, p2), all row-major.
ck_status ck_reprojection_jacobians(const ck_camera* camera, const ck_pose* pose,
                                    const double* point, const double* pixel, double* residual,
                                    double* pose_jacobian, double* point_jacobian,
                                    double* camera_jacobian);

#ifdef __cplusplus
}
#endif
#endif
