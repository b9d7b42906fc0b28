#ifndef CK_MATCHING_H
#define CK_MATCHING_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Options of descriptor matching.
typedef struct {
  /// Lowe's ratio test: the best distance must be below this fraction of the second best.
  double ratio;
  /// Largest descriptor distance of a match, in units in which a root-SIFT descriptor has length
  /// 512.
  double maximum_distance;
  /// All instruction sets give the same result.
  ck_instructions instructions;
} ck_match_options;

/// Matches descriptors by exact nearest neighbors: mutually nearest, with the ratio test in both
/// directions.
///
/// At most 65,536 descriptors of 128 bytes per side. `pairs` receives (first, second) indices, the
/// most distinctive pair (smallest ratio of best to second best) first; it holds `2 ×
/// min(first_count, second_count)` elements. Ties go to the lower index.
ck_status ck_match_descriptors(const uint8_t* first, size_t first_count, const uint8_t* second,
                               size_t second_count, const ck_match_options* options,
                               const ck_control* control, int32_t* pairs, size_t* pair_count);

/// Features of a photo for guided matching.
typedef struct {
  /// Descriptors of 128 bytes.
  const uint8_t* descriptors;
  /// (x, y) at depth 1 on the viewing rays; NaN excludes a feature.
  const double* points;
  size_t count;
} ck_features;

/// Options of guided matching.
typedef struct {
  /// Essential or fundamental matrix M, row-major: x₂ᵀ M x₁ = 0.
  double matrix[9];
  /// Largest Sampson error of a match, in units of the points.
  double maximum_error;
  /// As in `ck_match_options`; the second best is searched for only near the epipolar line.
  double ratio;
  double maximum_distance;
} ck_guided_match_options;

/// Matches features within a band around their epipolar lines: mutually nearest, with the ratio
/// test in both directions.
///
/// Similar features elsewhere in the photo do not count against a match. `pairs` receives indices
/// as in `ck_match_descriptors`.
ck_status ck_match_guided(const ck_features* first, const ck_features* second,
                          const ck_guided_match_options* options, const ck_control* control,
                          int32_t* pairs, size_t* pair_count);

/// Options of the search for repeated features.
typedef struct {
  /// Half the side of a descriptor's window, in units of the feature's scale. Features whose
  /// windows overlap are no repetition.
  double window_radius;
  /// Largest descriptor distance of two features that look the same, as in `ck_match_options`.
  double maximum_distance;
} ck_repetition_options;

/// Finds the features that look like another feature of the same photo.
///
/// `positions` are (x, y) in pixels, `scales` in pixels. `is_repeated` receives 0 or 1 for each of
/// the `query_count` indices in `queries`.
ck_status ck_find_repeated_features(const uint8_t* descriptors, const float* positions,
                                    const float* scales, size_t count, const int32_t* queries,
                                    size_t query_count, const ck_repetition_options* options,
                                    const ck_control* control, uint8_t* is_repeated);

#ifdef __cplusplus
}
#endif
#endif
