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
  /// Bounds in radians of the scale of the robust loss, which is three times the median error.
  double smallest_scale, largest_scale;
  /// Stops when the mean change of a rotation falls below this angle in radians.
  double tolerance;
} ck_rotation_averaging_options;

/// Averages relative rotations: L1 averaging first, then a robust loss (Chatterjee and Govindu,
/// "Efficient and robust large-scale rotation averaging", ICCV 2013).
///
/// `rotations` holds a quaternion x, y, z, w of `cameraFromWorld` for each photo; on entry, the
/// initial values. The pairs must connect all photos; photo 0 keeps its rotation. `errors` receives
/// the angular residual of each pair in radians.
ck_status ck_average_rotations(double* rotations, size_t photo_count, double* errors,
                               const ck_relative_rotation* pairs, size_t pair_count,
                               const ck_rotation_averaging_options* options,
                               const ck_control* control);

/// The direction in world coordinates from the camera of photo `photo` to point `point`.
typedef struct {
  int32_t photo, point;
  /// Unit vector.
  double x, y, z;
} ck_direction;

/// Options of global positioning.
typedef struct {
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
  bool converged;
} ck_positioning_summary;

/// Estimates camera centers and points jointly from the directions between them (Pan et al.,
/// "Global structure-from-motion revisited", ECCV 2024): minimizes Σ ρ(v − d (X − c)) over centers
/// c, points X and one factor d > 0 per direction, where ρ is the Huber loss.
///
/// `centers` and `points` are triples x, y, z; on entry, the initial values. The gauge of the
/// result (a similarity: position, orientation and scale) is arbitrary. The directions are grouped
/// by point, ascending. Runs on one thread.
ck_status ck_position_globally(double* centers, size_t photo_count, double* points,
                               size_t point_count, const ck_direction* directions,
                               size_t direction_count, ck_positioning_summary* summary,
                               const ck_positioning_options* options, const ck_control* control);

#ifdef __cplusplus
}
#endif
#endif
