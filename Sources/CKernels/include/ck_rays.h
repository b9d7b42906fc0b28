#ifndef CK_RAYS_H
#define CK_RAYS_H

#include "ck_camera.h"
#include "ck_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A triangle mesh with a ray casting structure. Immutable; may be used by several threads.
typedef struct ck_ray_scene ck_ray_scene;

/// Builds a ray casting structure with Embree; copies the arrays. Free with `ck_ray_scene_free`.
///
/// Returns `ck_invalid_argument` for a mesh without triangles, or with vertices that are not
/// finite.
ck_status ck_ray_scene_create(const ck_mesh* mesh, const ck_control* control, ck_ray_scene** scene);

/// Frees the scene; null does nothing.
void ck_ray_scene_free(ck_ray_scene* scene);

/// One triangle as observed in one view.
typedef struct {
  /// Projected area in pixels; 0 if any part of the triangle is not visible.
  float area;
  /// Cosine of the angle between the triangle's normal and the direction to the camera.
  float cosine;
  /// Mean magnitude of the luminance gradient in the triangle, in gray levels (0…255) per pixel.
  float gradient;
  /// False if the silhouette of an occluder in front of the triangle is within the margin: with a
  /// small error of the pose or the surface, the triangle would take the occluder's color.
  bool is_clear;
  /// False if within the margin the surface ends in front of a distant background or of empty
  /// space, or the mask ends: the same error would take the background's color.
  bool is_interior;
  /// Mean RGB color, 0…255.
  float color[3];
} ck_face_observation;

/// Visibility thresholds of a triangle in a view.
typedef struct {
  /// Triangles observed at a smaller cosine count as not visible.
  float minimum_cosine;
  /// Smallest distance of a triangle from the image border, in pixels; also used for `is_clear` and
  /// `is_interior`.
  float margin;
} ck_observe_options;

/// Determines which triangles of the scene are entirely visible in a view, and measures them. `rgb`
/// has 3 bytes per pixel, `observations` holds one entry for every triangle of the scene. `mask` is
/// null, or has one byte per pixel: triangles that reach pixels below 128 are not visible.
ck_status ck_observe_faces(const ck_ray_scene* scene, const ck_view* view, const uint8_t* rgb,
                           const uint8_t* mask, const ck_observe_options* options,
                           const ck_control* control, ck_face_observation* observations);

/// Sets `is_blocked[i]` to 1 if the surface lies between point i of `from` and point i of `to`,
/// else to 0. `from` may be on the surface: the first thousandth of the way is ignored.
ck_status ck_find_blocked(const ck_ray_scene* scene, ck_span from, ck_span to,
                          const ck_control* control, uint8_t* is_blocked);

#ifdef __cplusplus
}
#endif
#endif
