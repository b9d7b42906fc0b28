#ifndef CK_MATCHING_H
#define CK_MATCHING_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Which instructions `ck_match_descriptors` uses. All give the same result.
typedef enum {
  ck_simd_automatic = 0,
  ck_simd_portable = 1,
  ck_simd_avx2 = 2,
  ck_simd_avx512_vnni = 3,
} ck_simd_path;

typedef struct {
  /// The best distance is below this fraction of the second best (Lowe's ratio test).
  double ratio;
  /// Largest distance of a match, in units where a root-SIFT descriptor has length 512.
  double maximum_distance;
  ck_simd_path path;
} ck_match_options;

/// Whether this processor can run `path`.
bool ck_simd_supported(ck_simd_path path);

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
