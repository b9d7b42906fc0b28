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
  /// Trust in it, above 0.
  double weight;
} ck_relative_rotation;

/// How rotations are averaged.
typedef struct {
  /// Iterations with weights that minimise the sum of angles, and then with robust weights.
  int32_t absolute_iterations, robust_iterations;
  /// Scale in radians of the robust loss: it is three times the median error, within these.
  double smallest_scale, largest_scale;
  /// Stops when the mean change of a rotation falls below this, in radians.
  double tolerance;
} ck_rotation_averaging_options;

/// Finds the rotations that agree best with relative ones: least sum of angles first, then a robust
/// loss (Chatterjee and Govindu, "Efficient and robust large-scale rotation averaging", ICCV 2013).
///
/// `rotations` holds a quaternion x, y, z, w of `cameraFromWorld` for each photo, the start on
/// entry. The pairs must connect all photos; photo 0 keeps its rotation. `errors` receives for each
/// pair by how many radians it disagrees.
ck_status ck_average_rotations(double* rotations, size_t photo_count, double* errors,
                               const ck_relative_rotation* pairs, size_t pair_count,
                               const ck_rotation_averaging_options* options,
                               const ck_control* control);

/// The direction, in the world, in which photo `photo` sees point `point`.
typedef struct {
  int32_t photo, point;
  /// Of length 1.
  double x, y, z;
} ck_direction;

/// How cameras and points are placed.
typedef struct {
  int32_t max_iterations;
  /// Where the Huber loss turns from square to linear; residuals are about sines of angles.
  double huber_width;
  /// Stops when the relative decrease of the cost falls below this.
  double function_tolerance;
} ck_positioning_options;

/// How the placement went; costs are sums of ρ.
typedef struct {
  double initial_cost, final_cost;
  int32_t iterations;
  bool converged;
} ck_positioning_summary;

/// Finds the places of cameras and points together from the directions between them (Pan et al.,
/// "Global structure-from-motion revisited", ECCV 2024): minimises Σ ρ(v − d (X − c)) over centres
/// c, points X and a factor d > 0 for each direction, ρ the Huber loss.
///
/// `centers` and `points` are triples x, y, z, the start on entry; position, orientation and unit
/// of the result are as good as random. The directions are grouped by point, ascending. Runs on one
/// thread.
ck_status ck_position_globally(double* centers, size_t photo_count, double* points,
                               size_t point_count, const ck_direction* directions,
                               size_t direction_count, ck_positioning_summary* summary,
                               const ck_positioning_options* options, const ck_control* control);

#ifdef __cplusplus
}
#endif
#endif
