#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vectors.h"
#include "patches/grid.h"

#define CK_PATCH_KERNELS portable_kernels

namespace ck::patches {
namespace {
CK_INLINE void gather(I16& out, const uint32_t* base, const I16& index) {
  for (int i = 0; i < 16; ++i) out[i] = static_cast<int32_t>(base[index[i]]);
}

/// Permutation of eight sources to 16 lanes, four for each of four sources.
using Lanes = const uint8_t*;

CK_INLINE Lanes lanes_of(const uint8_t* sources) { return sources; }

CK_INLINE F16 spread(const F8& values, Lanes lanes) {
  float from[8];
  __builtin_memcpy(from, &values, sizeof from);
  F16 out;
  out.lo.lo = from[lanes[0]];
  out.lo.hi = from[lanes[1]];
  out.hi.lo = from[lanes[2]];
  out.hi.hi = from[lanes[3]];
  return out;
}

CK_INLINE F8 permute(const F8& values, const uint8_t* sources) {
  float from[8];
  __builtin_memcpy(from, &values, sizeof from);
  F8 out;
  for (int i = 0; i < 8; ++i) out[i] = from[sources[i]];
  return out;
}

CK_INLINE unsigned mask(const I8& lanes) {
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= static_cast<unsigned>(lanes[i] < 0) << i;
  return bits;
}
}  // namespace
}  // namespace ck::patches

#include "patches/score.inl"
