#include <algorithm>
#include <cmath>

#include "core/vectors.h"
#include "patches/grid.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define CK_PATCH_KERNELS avx512_kernels
#pragma clang attribute push(__attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,fma"))), \
                             apply_to = function)

namespace ck::patches {
namespace {
inline __attribute__((always_inline)) void gather(I16& out, const uint32_t* base,
                                                  const I16& index) {
  __m512i lanes;
  __builtin_memcpy(&lanes, &index, sizeof lanes);
  lanes = _mm512_i32gather_epi32(lanes, base, 4);
  __builtin_memcpy(&out, &lanes, sizeof lanes);
}

inline __attribute__((always_inline)) F16 spread(const F8& values, const I16& lanes) {
  __m256 from;
  __m512i index;
  __builtin_memcpy(&from, &values, sizeof from);
  __builtin_memcpy(&index, &lanes, sizeof index);
  const __m512 to = _mm512_permutexvar_ps(index, _mm512_castps256_ps512(from));
  F16 out;
  __builtin_memcpy(&out, &to, sizeof out);
  return out;
}

inline __attribute__((always_inline)) unsigned mask(const I8& lanes) {
  __m256 signs;
  __builtin_memcpy(&signs, &lanes, sizeof signs);
  return static_cast<unsigned>(_mm256_movemask_ps(signs));
}
}  // namespace
}  // namespace ck::patches

#include "patches/score.inl"

#pragma clang attribute pop
#else
namespace ck::patches {
const Kernels& avx512_kernels() { return portable_kernels(); }
}  // namespace ck::patches
#endif
