#include <algorithm>
#include <cmath>

#include "core/vectors.h"
#include "features/scale_space.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define CK_SIFT_KERNELS avx512_kernels
#pragma clang attribute push(__attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,fma"))), \
                             apply_to = function)

namespace ck::sift {
namespace {

CK_INLINE uint32_t lane_bits(const I16& lanes) {
  __m512i word;
  __builtin_memcpy(&word, &lanes, sizeof word);
  return _mm512_movepi32_mask(word);
}

/// Gathers each pixel together with its right neighbor.
CK_INLINE void gather(U16& out, const uint16_t* base, const I16& index) {
  __m512i lanes;
  __builtin_memcpy(&lanes, &index, sizeof lanes);
  lanes = _mm512_i32gather_epi32(lanes, base, 2);
  __builtin_memcpy(&out, &lanes, sizeof lanes);
}

}  // namespace
}  // namespace ck::sift

#include "features/gaussian_blur.inl"

#include "features/scale_space.inl"

#include "features/describe.inl"

#pragma clang attribute pop
#else
namespace ck::sift {
const Kernels& avx512_kernels() { return portable_kernels(); }
}  // namespace ck::sift
#endif
