#include "core/guard.h"
#include "patches/grid.h"

namespace ck::patches {
namespace {

bool has_avx512() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace

const Kernels& kernels(ck_patch_instructions instructions) {
  require(ck_patches_supported(instructions), "this processor does not have the instructions");
  switch (instructions) {
    case ck_patch_portable:
      return portable_kernels();
    case ck_patch_avx2:
      return avx2_kernels();
    case ck_patch_avx512:
      return avx512_kernels();
    case ck_patch_automatic:
      break;
  }
  return has_avx512() ? avx512_kernels() : has_avx2() ? avx2_kernels() : portable_kernels();
}

}  // namespace ck::patches

bool ck_patches_supported(ck_patch_instructions instructions) {
  switch (instructions) {
    case ck_patch_avx2:
      return ck::patches::has_avx2();
    case ck_patch_avx512:
      return ck::patches::has_avx512();
    case ck_patch_automatic:
    case ck_patch_portable:
      return true;
  }
  return false;
}
