#include <algorithm>
#include <cmath>

#include "core/vectors.h"
#include "features/scale_space.h"

#define CK_SIFT_KERNELS portable_kernels

namespace ck::sift {
namespace {

CK_INLINE uint32_t lane_bits(const I16& lanes) {
  uint32_t bits = 0;
  for (int i = 0; i < 16; ++i) bits |= static_cast<uint32_t>(lanes[i] != 0) << i;
  return bits;
}

CK_INLINE void gather(U16& out, const uint16_t* base, const I16& index) {
  for (int i = 0; i < 16; ++i) {
    out[i] = uint32_t{base[index[i]]} | uint32_t{base[index[i] + 1]} << 16;
  }
}

}  // namespace
}  // namespace ck::sift

#include "features/gaussian_blur.inl"

#include "features/scale_space.inl"

#include "features/describe.inl"
