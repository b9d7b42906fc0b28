#ifndef CK_CAMERA_H
#define CK_CAMERA_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A pinhole camera with OpenCV's distortion model, in pixels. The origin is the corner of the
/// top-left pixel.
typedef struct {
  double fx, fy, cx, cy;
  double k1, k2, p1, p2;
} ck_camera_model;

/// `cameraFromWorld`: a unit quaternion and a translation. x right, y down, z forward.
typedef struct {
  double qx, qy, qz, qw;
  double tx, ty, tz;
} ck_pose;

/// The pixel position at which photo `photo` observes point `point`.
typedef struct {
  int32_t photo;
  int32_t point;
  double x, y;
} ck_observation;

/// Cameras and photos with poses; `photo_cameras` holds an index into `cameras` for each photo.
typedef struct {
  const ck_camera_model* cameras;
  size_t camera_count;
  const ck_pose* poses;
  const int32_t* photo_cameras;
  size_t photo_count;
} ck_views;

#ifdef __cplusplus
}
#endif
#endif
