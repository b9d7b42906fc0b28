#ifndef CK_TWO_VIEW_H
#define CK_TWO_VIEW_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

// Points are (x, y) pairs at depth 1 of the viewing rays: pixels freed from distortion, minus the
// principal point, divided by the focal length. Matrices M have x₂ᵀ M x₁ = 0 and are stored by
// rows.

/// All essential matrices through five matches (Nistér, PAMI 2004); both arrays hold 5 points.
///
/// `matrices` holds 20 × 9 numbers, each matrix of Frobenius norm 1.
ck_status ck_five_point(const double* first, const double* second, double* matrices, size_t* count);

/// All fundamental matrices through seven matches; `matrices` holds 6 × 9 numbers of norm 1.
ck_status ck_seven_point(const double* first, const double* second, double* matrices,
                         size_t* count);

/// How the geometry of two views is searched for.
typedef struct {
  /// Estimate an essential matrix; otherwise a fundamental one.
  bool is_calibrated;
  /// Largest Sampson error of an inlier in units of the points.
  double maximum_error;
  /// Probability with which the best model is to be found.
  double confidence;
  /// Samples drawn at least and at most.
  int32_t minimum_iterations;
  int32_t maximum_iterations;
  /// The same seed gives the same geometry.
  uint64_t seed;
} ck_two_view_options;

/// The geometry of two views.
typedef struct {
  /// Essential or fundamental matrix of norm 1.
  double matrix[9];
  /// x, y, z, w of the rotation of second-from-first; of the nearest essential matrix if
  /// uncalibrated.
  double rotation[4];
  /// Unit length.
  double translation[3];
  size_t inlier_count;
  /// Inliers that one homography explains as well.
  size_t homography_inlier_count;
  /// Median angle in radians between the rays of the inliers.
  double median_angle;
  int32_t iterations;
} ck_two_view_result;

/// Estimates the geometry of two views by LO-RANSAC (Chum, Matas and Kittler, DAGM 2003) with an
/// MSAC score, samples that start with the first matches (after Chum and Matas' PROSAC, CVPR 2005),
/// and refinement of the Sampson error.
///
/// Matches are in order of quality, the best first. `inliers` holds `count` bytes. Returns
/// `ck_degenerate` when no model is found.
ck_status ck_two_view_estimate(const double* first, const double* second, size_t count,
                               const ck_two_view_options* options, const ck_control* control,
                               ck_two_view_result* result, uint8_t* inliers);

/// What a pair says about the focal length: for each factor the sum of min(Sampson error², limit²),
/// in the units of the points, of the best pose when the focal length is `factor` times the assumed
/// one. `fundamental` is where the search for the pose starts.
ck_status ck_focal_length_costs(const double* first, const double* second, size_t count,
                                const double* fundamental, double maximum_error,
                                const double* factors, size_t factor_count,
                                const ck_control* control, double* costs);

#ifdef __cplusplus
}
#endif
#endif
