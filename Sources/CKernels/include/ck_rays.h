#ifndef CK_RAYS_H
#define CK_RAYS_H

#include "ck_camera.h"
#include "ck_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A surface prepared for ray casting. Immutable; may be used from several threads.
typedef struct ck_ray_scene ck_ray_scene;

/// Prepares a surface for ray casting; copies the arrays. Free with `ck_ray_scene_free`.
ck_status ck_ray_scene_create(const ck_mesh* mesh, const ck_control* control, ck_ray_scene** scene);

/// Frees the scene; null does nothing.
void ck_ray_scene_free(ck_ray_scene* scene);

/// What one view shows of one triangle.
typedef struct {
  /// Pixels that the triangle covers; 0 when the view does not see all of it.
  float area;
  /// Cosine of the angle between the triangle's normal and the direction to the camera.
  float cosine;
  /// Mean length of the luminance gradient in the triangle, 0…255 a pixel.
  float gradient;
  /// False where the boundary of something in front of the triangle is within the margin: an error
  /// of the camera or the surface would take its color.
  bool is_clear;
  /// False where the surface ends within the margin and something far behind it, or nothing,
  /// begins, or where the mask ends: the same error would take the background's color.
  bool is_interior;
  /// Mean colour, 0…255.
  float color[3];
} ck_face_observation;

/// When a view sees a triangle.
typedef struct {
  /// Triangles seen at a smaller cosine count as not seen.
  float minimum_cosine;
  /// Pixels that a triangle keeps from the border of the image; see `is_clear` and `is_interior`
  /// too.
  float margin;
} ck_observe_options;

/// Finds which triangles of the scene a view sees whole, and how. `rgb` has 3 bytes a pixel,
/// `observations` holds one entry for every triangle of the scene. `mask` is null, or has a byte a
/// pixel: a view doesn't see triangles that reach to where it is below 128.
ck_status ck_observe_faces(const ck_ray_scene* scene, const ck_view* view, const uint8_t* rgb,
                           const uint8_t* mask, const ck_observe_options* options,
                           const ck_control* control, ck_face_observation* observations);

#ifdef __cplusplus
}
#endif
#endif
