#include <algorithm>
#include <cmath>

#include "core/vectors.h"
#include "patches/grid.h"

#define CK_PATCH_KERNELS portable_kernels

namespace ck::patches {
namespace {
inline __attribute__((always_inline)) void gather(I16& out, const uint32_t* base,
                                                  const I16& index) {
  for (int i = 0; i < 16; ++i) out[i] = static_cast<int32_t>(base[index[i]]);
}

inline __attribute__((always_inline)) F16 spread(const F8& values, const I16& lanes) {
  F16 out;
  for (int i = 0; i < 16; ++i) out[i] = values[lanes[i]];
  return out;
}

inline __attribute__((always_inline)) unsigned mask(const I8& lanes) {
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= static_cast<unsigned>(lanes[i] < 0) << i;
  return bits;
}
}  // namespace
}  // namespace ck::patches

#include "patches/score.inl"
