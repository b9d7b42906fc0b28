#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vectors.h"
#include "patches/grid.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define CK_PATCH_KERNELS avx2_kernels
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)

namespace ck::patches {
namespace {
CK_INLINE void gather(I16& out, const uint32_t* base, const I16& index) {
  const int* words = reinterpret_cast<const int*>(base);
  __m256i lanes[2];
  __builtin_memcpy(lanes, &index, sizeof lanes);
  lanes[0] = _mm256_i32gather_epi32(words, lanes[0], 4);
  lanes[1] = _mm256_i32gather_epi32(words, lanes[1], 4);
  __builtin_memcpy(&out, lanes, sizeof lanes);
}

/// Permutation of eight sources to 16 lanes, four for each of four sources.
struct Lanes {
  __m256i lo, hi;
};

CK_INLINE Lanes lanes_of(const uint8_t* sources) {
  const __m128i each = _mm_set_epi8(3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0);
  const __m128i bytes = _mm_shuffle_epi8(_mm_loadu_si32(sources), each);
  return {_mm256_cvtepu8_epi32(bytes), _mm256_cvtepu8_epi32(_mm_srli_si128(bytes, 8))};
}

CK_INLINE F16 spread(const F8& values, const Lanes& lanes) {
  __m256 from, to[2];
  __builtin_memcpy(&from, &values, sizeof from);
  to[0] = _mm256_permutevar8x32_ps(from, lanes.lo);
  to[1] = _mm256_permutevar8x32_ps(from, lanes.hi);
  F16 out;
  __builtin_memcpy(&out, to, sizeof out);
  return out;
}

CK_INLINE F8 permute(const F8& values, const uint8_t* sources) {
  __m256 from;
  __builtin_memcpy(&from, &values, sizeof from);
  const __m256 to = _mm256_permutevar8x32_ps(from, _mm256_cvtepu8_epi32(_mm_loadu_si64(sources)));
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
const Kernels& avx2_kernels() { return portable_kernels(); }
}  // namespace ck::patches
#endif
