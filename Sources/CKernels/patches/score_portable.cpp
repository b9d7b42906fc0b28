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
}  // namespace
}  // namespace ck::patches

#include "patches/score.inl"
