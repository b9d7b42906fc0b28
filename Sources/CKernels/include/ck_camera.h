#ifndef CK_CAMERA_H
#define CK_CAMERA_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A pinhole camera with OpenCV's distortion model.
///
/// `pixel = (fx, fy) · distorted (x / z, y / z) + (cx, cy)`; the pixel origin is the corner of the
/// top-left pixel. x points right, y down, z forward.
typedef struct {
  /// Focal lengths and principal point in pixels.
  double fx, fy, cx, cy;
  /// Coefficients of radial (k) and tangential (p) distortion.
  double k1, k2, p1, p2;
  /// Size of the photo in pixels.
  int32_t width, height;
} ck_camera;

/// `cameraFromWorld`, `x_camera = R · x_world + t`: a unit quaternion and a translation in world
/// units.
typedef struct {
  double qx, qy, qz, qw;
  double tx, ty, tz;
} ck_pose;

/// The camera and pose of an undistorted photo; the camera's distortion is ignored.
typedef struct {
  ck_camera camera;
  ck_pose camera_from_world;
} ck_view;

/// The pixel position at which photo `photo` observes point `point`.
typedef struct {
  int32_t photo;
  int32_t point;
  double x, y;
  /// The upper triangle of the square root of its information matrix, relative to the others: a
  /// residual (u, v) counts as (xx u + xy v, yy v). The identity has 1, 0, 1. Only bundle
  /// adjustment uses it.
  double xx, xy, yy;
} ck_observation;

/// Cameras, and photos with poses.
typedef struct {
  const ck_camera* cameras;
  size_t camera_count;
  const ck_pose* poses;
  /// Index into `cameras` for each photo.
  const int32_t* photo_cameras;
  size_t photo_count;
} ck_posed_photos;

/// Observations grouped by track: track i has the observations `offsets[i]..<offsets[i + 1]`. Their
/// `point` field is ignored.
typedef struct {
  /// `count + 1` ascending indices, the first 0.
  const int32_t* offsets;
  size_t count;
  const ck_observation* observations;
} ck_tracks;

#ifdef __cplusplus
}
#endif
#endif
