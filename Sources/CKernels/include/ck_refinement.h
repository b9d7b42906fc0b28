#ifndef CK_REFINEMENT_H
#define CK_REFINEMENT_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Samples per side of a template, including a border of one sample for derivatives. Chosen.
#define CK_TEMPLATE_SIDE 13
/// Number of samples of a template.
#define CK_TEMPLATE_SAMPLES (CK_TEMPLATE_SIDE * CK_TEMPLATE_SIDE)

/// A square image patch to locate in other photos.
typedef struct {
  /// Center in pixels of the image; the origin is the corner of the top-left pixel.
  double x, y;
  /// Spacing of the samples in pixels, at least 1.
  double step;
} ck_template_location;

/// Initial estimate of a template's location in another photo.
typedef struct {
  /// Index of the template.
  int32_t index;
  /// Spacing of the samples in pixels of the template's image.
  double step;
  /// Affine warp, row-major: the derivative of the pixel in this image with respect to the pixel in
  /// the template's image.
  double warp[4];
  /// The expected center in pixels.
  double x, y;
} ck_template_search;

/// Location of a template in another photo.
typedef struct {
  /// The estimated center in pixels.
  double x, y;
  /// Zero-mean normalized cross-correlation at the center, −1…1; −1 if the search failed.
  double zncc;
  /// The covariance of the center in square pixels, which least squares give from the texture of
  /// the template and the residuals (Gruen 1985).
  double xx, xy, yy;
} ck_template_match;

/// Extracts templates from a photo with 1, 3 (RGB) or 4 channels.
///
/// `samples` receives `CK_TEMPLATE_SAMPLES` values per location: 64 times the luma 0…255. `valid`
/// is set to 1 for each location whose square lies within the photo and has texture in two
/// directions, to 0 for the others.
ck_status ck_extract_templates(const ck_pixels* photo, const ck_template_location* locations,
                               size_t location_count, ck_instructions instructions,
                               uint16_t* samples, uint8_t* valid);

/// Locates templates in a photo by least squares matching (Gruen, "Adaptive least squares
/// correlation", 1985) of position, gain and offset, in the inverse compositional form (Baker and
/// Matthews, IJCV 2004). A search that moves more than `maximum_shift` pixels from its start fails.
///
/// `samples` holds those of `template_count` templates, `matches` one element per search.
ck_status ck_match_templates(const ck_pixels* photo, const uint16_t* samples, size_t template_count,
                             const ck_template_search* searches, size_t search_count,
                             double maximum_shift, ck_instructions instructions,
                             ck_template_match* matches);

#ifdef __cplusplus
}
#endif
#endif
