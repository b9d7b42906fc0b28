#ifndef CK_MATCHING_H
#define CK_MATCHING_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a match is.
typedef struct {
  /// The best distance is below this fraction of the second best (Lowe's ratio test).
  double ratio;
  /// Largest distance of a match, in units where a root-SIFT descriptor has length 512.
  double maximum_distance;
  /// All give the same result.
  ck_instructions instructions;
} ck_match_options;

/// Matches descriptors by exact nearest neighbours: mutual best with the ratio test both ways.
///
/// At most 65,536 descriptors of 128 bytes a side. `pairs` receives (first, second) indices, the
/// most distinctive pair (smallest ratio of best to second best) first; it holds `2 ×
/// min(first_count, second_count)` elements. Ties go to the lower index.
ck_status ck_match_descriptors(const uint8_t* first, size_t first_count, const uint8_t* second,
                               size_t second_count, const ck_match_options* options,
                               const ck_control* control, int32_t* pairs, size_t* pair_count);

/// The features of a photo that take part in guided matching.
typedef struct {
  /// Descriptors of 128 bytes.
  const uint8_t* descriptors;
  /// (x, y) at depth 1 of the viewing rays; not a number for features that don't take part.
  const double* points;
  size_t count;
} ck_features;

typedef struct {
  /// Essential or fundamental matrix M by rows, x₂ᵀ M x₁ = 0.
  double matrix[9];
  /// Largest Sampson error of a match in units of the points.
  double maximum_error;
  /// As in `ck_match_options`; the second best is looked for near the epipolar line only.
  double ratio;
  double maximum_distance;
} ck_guided_match_options;

/// Matches features among those near their epipolar line: mutual best with the ratio test both
/// ways.
///
/// What looks alike elsewhere in the photo doesn't count against a match. `pairs` receives indices
/// as in `ck_match_descriptors`.
ck_status ck_match_guided(const ck_features* first, const ck_features* second,
                          const ck_guided_match_options* options, const ck_control* control,
                          int32_t* pairs, size_t* pair_count);

#ifdef __cplusplus
}
#endif
#endif
