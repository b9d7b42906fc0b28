#include "core/vectors.h"
#include "patches/ask.h"

#define CK_ASK_KERNELS portable_ask

namespace ck::patches {
namespace {
inline __attribute__((always_inline)) void gather(F16& out, const float* base, const I16& index) {
  for (int i = 0; i < 16; ++i) out[i] = base[4 * static_cast<ptrdiff_t>(index[i])];
}
}  // namespace
}  // namespace ck::patches

#include "patches/ask.inl"
