#include <algorithm>
#include <cmath>

#include "core/vectors.h"
#include "patches/grid.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define CK_PATCH_KERNELS avx2_kernels
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)

namespace ck::patches {
namespace {
inline __attribute__((always_inline)) void gather(I16& out, const uint32_t* base,
                                                  const I16& index) {
  const int* words = reinterpret_cast<const int*>(base);
  __m256i lanes[2];
  __builtin_memcpy(lanes, &index, sizeof lanes);
  lanes[0] = _mm256_i32gather_epi32(words, lanes[0], 4);
  lanes[1] = _mm256_i32gather_epi32(words, lanes[1], 4);
  __builtin_memcpy(&out, lanes, sizeof lanes);
}

inline __attribute__((always_inline)) F16 spread(const F8& values, const I16& lanes) {
  __m256 from, to[2];
  __m256i index[2];
  __builtin_memcpy(&from, &values, sizeof from);
  __builtin_memcpy(index, &lanes, sizeof index);
  to[0] = _mm256_permutevar8x32_ps(from, index[0]);
  to[1] = _mm256_permutevar8x32_ps(from, index[1]);
  F16 out;
  __builtin_memcpy(&out, to, sizeof out);
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
const Kernels& avx2_kernels() { return portable_kernels(); }
}  // namespace ck::patches
#endif
