#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vectors.h"
#include "patches/grid.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define CK_PATCH_KERNELS avx512_kernels
#pragma clang attribute push(__attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,fma"))), \
                             apply_to = function)

namespace ck::patches {
namespace {
CK_INLINE void gather(I16& out, const uint32_t* base, const I16& index) {
  __m512i lanes;
  __builtin_memcpy(&lanes, &index, sizeof lanes);
  lanes = _mm512_i32gather_epi32(lanes, base, 4);
  __builtin_memcpy(&out, &lanes, sizeof lanes);
}

/// Permutation of eight sources to 16 lanes, four for each of four sources.
using Lanes = __m512i;

CK_INLINE Lanes lanes_of(const uint8_t* sources) {
  __m128i bytes = _mm_loadu_si32(sources);
  const __m128i each = _mm_set_epi8(3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0);
  return _mm512_cvtepu8_epi32(_mm_shuffle_epi8(bytes, each));
}

CK_INLINE F16 spread(const F8& values, const Lanes& lanes) {
  __m256 from;
  __builtin_memcpy(&from, &values, sizeof from);
  const __m512 to = _mm512_permutexvar_ps(lanes, _mm512_broadcast_f32x8(from));
  F16 out;
  __builtin_memcpy(&out, &to, sizeof out);
  return out;
}

CK_INLINE F8 permute(const F8& values, const uint8_t* sources) {
  __m256 from;
  __builtin_memcpy(&from, &values, sizeof from);
  const __m256i lanes = _mm256_cvtepu8_epi32(_mm_loadu_si64(sources));
  const __m256 to = _mm256_permutevar8x32_ps(from, lanes);
  F8 out;
  __builtin_memcpy(&out, &to, sizeof out);
  return out;
}

CK_INLINE unsigned mask(const I8& lanes) {
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
