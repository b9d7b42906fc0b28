#ifndef CK_FEATURES_H
#define CK_FEATURES_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Bytes of one descriptor.
#define CK_DESCRIPTOR_LENGTH 128

/// How features are detected.
typedef struct {
  /// Features kept at most; the output buffers hold as many.
  int32_t maximum_features;
  /// Scale samples of one octave.
  int32_t octave_layers;
  /// −1: the first octave is the photo at twice its size; 0: the photo as it is.
  int32_t first_octave;
  /// Lowe's contrast threshold at the lowest sensitivity, for intensities 0…1.
  double high_contrast_threshold;
  /// Lowe's contrast threshold at the highest sensitivity.
  double low_contrast_threshold;
  /// The threshold falls from high to low until this many features are found.
  int32_t sufficient_features;
  /// Lowe's limit on the ratio of principal curvatures.
  double edge_threshold;
  /// Gaussian blur of the first layer in pixels.
  double sigma;
  /// Cells along the longer side of the grid over which the strongest features are balanced.
  int32_t grid_cells;
  /// Vector instructions all give the same bytes; the portable path differs by rounding.
  ck_instructions instructions;
} ck_sift_options;

/// Detects SIFT features (Lowe, IJCV 2004) and describes them by root-SIFT bytes (Arandjelović and
/// Zisserman, CVPR 2012): `min(255, round(512 √(d / |d|₁)))`.
///
/// `pixels` is 8-bit with 1, 3 (RGB) or 4 (RGBA) channels, `row_stride` bytes a row. Positions (x,
/// y) are in pixels with the origin at the corner of the top-left pixel, scales are σ in pixels,
/// orientations in radians from x to y. The features are sorted by scale, largest first.
/// The caller owns the outputs, which hold `maximum_features` elements: 2 floats, 1 float, 1 float,
/// 128 bytes, and `color_stride` bytes of which 3 are written (RGB). `mask` is null, or has a byte
/// for each pixel, `width` a row: nothing is looked for where it is 0.
ck_status ck_sift_detect(const uint8_t* pixels, int32_t width, int32_t height, int32_t channels,
                         size_t row_stride, const uint8_t* mask, const ck_sift_options* options,
                         const ck_control* control, float* positions, float* scales,
                         float* orientations, uint8_t* descriptors, uint8_t* colors,
                         size_t color_stride, size_t* count);

#ifdef __cplusplus
}
#endif
#endif
