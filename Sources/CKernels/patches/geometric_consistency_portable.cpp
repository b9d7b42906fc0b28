#include "core/vectors.h"
#include "patches/geometric_consistency.h"

#define CK_CONSISTENCY_KERNELS portable_consistency

namespace ck::patches {
namespace {
CK_INLINE void gather(F16& out, const float* base, const I16& index) {
  for (int i = 0; i < 16; ++i) out[i] = base[4 * static_cast<ptrdiff_t>(index[i])];
}
}  // namespace
}  // namespace ck::patches

#include "patches/geometric_consistency.inl"
