#ifndef CK_TWO_VIEW_H
#define CK_TWO_VIEW_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

// Points are (x, y) pairs at depth 1 on the viewing rays: undistorted pixels, minus the principal
// point, divided by the focal length. Matrices M satisfy x₂ᵀ M x₁ = 0 and are row-major.

/// Five-point solver: all essential matrices that five matches determine (Nistér, PAMI 2004).
///
/// `first` and `second` hold 5 points, `matrices` 20 × 9 numbers: matrices of Frobenius norm 1.
ck_status ck_five_point(const double* first, const double* second, double* matrices, size_t* count);

/// Seven-point solver: all fundamental matrices that seven matches determine (Hartley and
/// Zisserman, "Multiple View Geometry", 2003, ch. 11).
///
/// `first` and `second` hold 7 points, `matrices` 6 × 9 numbers: matrices of Frobenius norm 1.
ck_status ck_seven_point(const double* first, const double* second, double* matrices,
                         size_t* count);

/// Matches as pairs of points; each array holds `count` pairs x, y.
typedef struct {
  const double* first;
  const double* second;
  size_t count;
} ck_point_pairs;

/// Options of two-view geometry estimation.
typedef struct {
  /// True to estimate an essential matrix, false for a fundamental matrix.
  bool is_calibrated;
  /// Largest Sampson error of an inlier, in units of the points.
  double maximum_error;
  /// Required probability of finding the best model.
  double confidence;
  /// Smallest and largest number of samples to draw.
  int32_t minimum_iterations;
  int32_t maximum_iterations;
  /// Random seed; the same seed gives the same geometry.
  uint64_t seed;
} ck_two_view_options;

/// Estimated geometry of two views.
typedef struct {
  /// Essential or fundamental matrix of Frobenius norm 1, row-major.
  double matrix[9];
  /// Quaternion x, y, z, w of the rotation of second-from-first; if uncalibrated, that of the
  /// nearest essential matrix.
  double rotation[4];
  /// Translation of second-from-first, of unit length.
  double translation[3];
  size_t inlier_count;
  /// Number of the inliers that a single homography explains as well.
  size_t homography_inlier_count;
  /// Median triangulation angle of the inliers, in radians.
  double median_angle;
  /// Number of samples drawn.
  int32_t iterations;
} ck_two_view_result;

/// Estimates the geometry of two views by LO-RANSAC (Chum, Matas and Kittler, DAGM 2003) with an
/// MSAC score, sampling that prefers the first matches (after PROSAC, Chum and Matas, CVPR 2005),
/// and refinement of the Sampson error.
///
/// Matches are sorted by quality, the best first. `inliers` holds one byte per match, which is set
/// to 1 or 0. Returns `ck_degenerate` if no model is found.
ck_status ck_two_view_estimate(const ck_point_pairs* pairs, const ck_two_view_options* options,
                               const ck_control* control, ck_two_view_result* result,
                               uint8_t* inliers);

/// Options of the focal length cost.
typedef struct {
  /// The fundamental matrix of the matches, row-major; initializes the search for the pose.
  double fundamental[9];
  /// Limit of a match's Sampson error, in units of the points.
  double maximum_error;
} ck_focal_length_options;

/// Cost of hypotheses about the focal length: for each factor, the sum of min(Sampson error²,
/// limit²), in squared units of the points, of the best pose when the focal length is `factor`
/// times the assumed one. `costs` holds one number per factor.
ck_status ck_focal_length_costs(const ck_point_pairs* pairs, const double* factors,
                                size_t factor_count, const ck_focal_length_options* options,
                                const ck_control* control, double* costs);

#ifdef __cplusplus
}
#endif
#endif
