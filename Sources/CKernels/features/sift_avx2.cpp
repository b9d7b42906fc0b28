#include <algorithm>
#include <cmath>

#include "core/vectors.h"
#include "features/scale_space.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define CK_SIFT_KERNELS avx2_kernels
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)

namespace ck::sift {
namespace {

CK_INLINE uint32_t lane_bits(const I16& lanes) {
  __m256 halves[2];
  __builtin_memcpy(halves, &lanes, sizeof halves);
  return static_cast<uint32_t>(_mm256_movemask_ps(halves[0])) |
         static_cast<uint32_t>(_mm256_movemask_ps(halves[1])) << 8;
}

/// Gathers each pixel together with its right neighbor.
CK_INLINE void gather(U16& out, const uint16_t* base, const I16& index) {
  const int* words = reinterpret_cast<const int*>(base);
  __m256i lanes[2];
  __builtin_memcpy(lanes, &index, sizeof lanes);
  lanes[0] = _mm256_i32gather_epi32(words, lanes[0], 2);
  lanes[1] = _mm256_i32gather_epi32(words, lanes[1], 2);
  __builtin_memcpy(&out, lanes, sizeof lanes);
}

}  // namespace
}  // namespace ck::sift

#include "features/gaussian_blur.inl"

#include "features/scale_space.inl"

#include "features/describe.inl"

#pragma clang attribute pop
#else
namespace ck::sift {
const Kernels& avx2_kernels() { return portable_kernels(); }
}  // namespace ck::sift
#endif
