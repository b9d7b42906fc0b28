#include "core/vectors.h"
#include "patches/geometric_consistency.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define CK_CONSISTENCY_KERNELS avx2_consistency
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)

namespace ck::patches {
namespace {
/// Gathers with a stride of four floats, the size of `ck_patch`.
CK_INLINE void gather(F16& out, const float* base, const I16& index) {
  const I16 word = index * 4;
  __m256i lanes[2];
  __builtin_memcpy(lanes, &word, sizeof lanes);
  const __m256 values[2] = {_mm256_i32gather_ps(base, lanes[0], 4),
                            _mm256_i32gather_ps(base, lanes[1], 4)};
  __builtin_memcpy(&out, values, sizeof values);
}
}  // namespace
}  // namespace ck::patches

#include "patches/geometric_consistency.inl"

#pragma clang attribute pop
#else
namespace ck::patches {
const ConsistencyKernels& avx2_consistency() { return portable_consistency(); }
}  // namespace ck::patches
#endif
