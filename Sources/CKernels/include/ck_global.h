#ifndef CK_GLOBAL_H
#define CK_GLOBAL_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A measured rotation between two photos: `R_second = R · R_first`.
typedef struct {
  int32_t first, second;
  /// Unit quaternion of `secondFromFirst`.
  double qx, qy, qz, qw;
  /// Weight of the measurement, above 0.
  double weight;
} ck_relative_rotation;

/// Options of rotation averaging.
typedef struct {
  /// Iterations of L1 averaging (reweighted to minimize the sum of angles), followed by iterations
  /// with the robust loss.
  int32_t absolute_iterations, robust_iterations;
  /// Bounds in radians of the scale of the robust loss, which is three times the median residual.
  double minimum_scale, maximum_scale;
  /// Stops when the mean change of a rotation falls below this angle in radians.
  double tolerance;
} ck_rotation_averaging_options;

/// Averages relative rotations: L1 averaging first, then the robust loss of Geman and McClure
/// (Chatterjee and Govindu, "Efficient and robust large-scale rotation averaging", ICCV 2013).
///
/// Photo 0 keeps its rotation. Returns `ck_degenerate` if the pairs do not connect all photos.
/// `rotations` holds a quaternion of
/// `cameraFromWorld` (4 doubles x, y, z, w) for each photo; on entry, the initial values. `errors`
/// receives the angular residual of each pair in radians.
ck_status ck_average_rotations(const ck_relative_rotation* pairs, size_t pair_count,
                               const ck_rotation_averaging_options* options,
                               const ck_control* control, ck_mutable_span rotations,
                               double* errors);

/// The direction in world coordinates from the camera of photo `photo` to point `point`.
typedef struct {
  int32_t photo, point;
  /// Unit vector.
  double x, y, z;
} ck_direction;

/// Options of global positioning.
typedef struct {
  /// Largest number of Levenberg–Marquardt iterations.
  int32_t maximum_iterations;
  /// Residual at which the Huber loss changes from quadratic to linear; residuals approximate sines
  /// of angles.
  double huber_width;
  /// Stops when the relative decrease of the cost falls below this value.
  double function_tolerance;
} ck_positioning_options;

/// Summary of global positioning; costs are sums of ρ.
typedef struct {
  double initial_cost, final_cost;
  int32_t iterations;
  /// Whether the relative decrease of the cost fell below `function_tolerance`.
  bool converged;
} ck_positioning_summary;

/// Estimates camera centers and points jointly from the directions between them (Pan et al.,
/// "Global structure-from-motion revisited", ECCV 2024): minimizes Σ ρ(v − d (X − c)) over centers
/// c, points X and one factor d > 0 per direction, where ρ is the Huber loss.
///
/// The directions are grouped by point, ascending. `centers` and `points` (3 doubles) hold the
/// initial values on entry; the position and scale of the result are arbitrary (gauge freedom), its
/// orientation is that of the directions. Runs on one thread.
ck_status ck_position_globally(const ck_direction* directions, size_t direction_count,
                               const ck_positioning_options* options, const ck_control* control,
                               ck_mutable_span centers, ck_mutable_span points,
                               ck_positioning_summary* summary);

#ifdef __cplusplus
}
#endif
#endif
