#ifndef CK_REFINEMENT_H
#define CK_REFINEMENT_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Samples along a side of a template, its border of one sample for derivatives included.
#define CK_TEMPLATE_SIDE 13
/// Samples of a template.
#define CK_TEMPLATE_SAMPLES (CK_TEMPLATE_SIDE * CK_TEMPLATE_SIDE)

/// A square of texture to be found again in other photos.
typedef struct {
  /// Its centre in pixels of the image, origin at the corner of the top-left pixel.
  double x, y;
  /// Pixels from one sample to the next, at least 1.
  double step;
} ck_template_place;

/// Where a template is expected in another photo.
typedef struct {
  /// Index of the template.
  int32_t index;
  /// Pixels of the template's image from one sample to the next.
  double step;
  /// The derivative, by rows, of the pixel in this image by the pixel in the template's image.
  double warp[4];
  /// The expected centre.
  double x, y;
} ck_template_search;

/// Where a template was found in another photo.
typedef struct {
  /// The centre found, in pixels.
  double x, y;
  /// Zero-mean normalised cross-correlation there, −1…1; −1 where nothing was found.
  double zncc;
} ck_template_find;

/// Reads templates from an image with 1, 3 (RGB) or 4 channels.
///
/// `samples` receives `CK_TEMPLATE_SAMPLES` values a place, 64 times the luma 0…255; `valid`
/// becomes 1 where the square lies within the image and holds texture in two directions.
ck_status ck_extract_templates(const uint8_t* pixels, int32_t width, int32_t height,
                               int32_t channels, size_t row_stride, const ck_template_place* places,
                               size_t count, uint16_t* samples, uint8_t* valid);

/// Finds templates in an image by least squares matching (Gruen, "Adaptive least squares
/// correlation", 1985) of position, gain and offset, in the inverse compositional form (Baker and
/// Matthews, IJCV 2004). A search gives up that leaves `max_shift` pixels from where it began.
ck_status ck_match_templates(const uint8_t* pixels, int32_t width, int32_t height, int32_t channels,
                             size_t row_stride, const uint16_t* samples, size_t template_count,
                             const ck_template_search* searches, size_t count, double max_shift,
                             ck_template_find* finds);

#ifdef __cplusplus
}
#endif
#endif
