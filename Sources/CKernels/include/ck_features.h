#ifndef CK_FEATURES_H
#define CK_FEATURES_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Size of one descriptor in bytes.
#define CK_DESCRIPTOR_LENGTH 128

/// Options of SIFT detection.
typedef struct {
  /// Largest number of features to keep; the capacity of the output buffers.
  int32_t maximum_features;
  /// Number of scale samples per octave.
  int32_t octave_layers;
  /// −1: the first octave is the photo at twice its size; 0: the photo at its original size.
  int32_t first_octave;
  /// Lowe's contrast threshold at the lowest sensitivity, for intensities 0…1.
  double high_contrast_threshold;
  /// Lowe's contrast threshold at the highest sensitivity.
  double low_contrast_threshold;
  /// The contrast threshold is lowered from high to low until this many features are found.
  int32_t sufficient_features;
  /// Lowe's limit on the ratio of principal curvatures.
  double edge_threshold;
  /// Standard deviation of the Gaussian blur of the first layer, in pixels.
  double sigma;
  /// Number of cells along the longer side of the grid over which the strongest features are
  /// balanced.
  int32_t grid_cells;
  /// All vector instruction sets give the same bytes; the portable code differs by rounding.
  ck_instructions instructions;
} ck_sift_options;

/// Buffers for the detected features, owned by the caller; each holds `maximum_features` elements.
typedef struct {
  /// x, y in pixels; the origin is the corner of the top-left pixel.
  float* positions;
  /// σ in pixels.
  float* scales;
  /// Radians from x to y.
  float* orientations;
  /// `CK_DESCRIPTOR_LENGTH` bytes each.
  uint8_t* descriptors;
  /// RGB, 3 bytes.
  ck_mutable_span colors;
} ck_sift_output;

/// Detects SIFT features (Lowe, IJCV 2004) and computes root-SIFT descriptors (Arandjelović and
/// Zisserman, CVPR 2012): `min(255, round(512 √(d / |d|₁)))` as bytes.
///
/// `photo` has 1, 3 (RGB) or 4 (RGBA) channels. `mask` is null, or has one byte per pixel, `width`
/// per row: features at pixels where it is 0 are discarded. `count` receives the number of
/// features, which are sorted by scale, largest first.
ck_status ck_sift_detect(const ck_pixels* photo, const uint8_t* mask,
                         const ck_sift_options* options, const ck_control* control,
                         const ck_sift_output* features, size_t* count);

#ifdef __cplusplus
}
#endif
#endif
