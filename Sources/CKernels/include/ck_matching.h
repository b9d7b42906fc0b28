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

#ifdef __cplusplus
}
#endif
#endif
