#include "core/guard.h"
#include "features/scale_space.h"

namespace ck::sift {
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

const Kernels& kernels(ck_sift_instructions instructions) {
  require(ck_sift_supported(instructions), "this processor does not have the instructions");
  switch (instructions) {
    case ck_sift_portable:
      return portable_kernels();
    case ck_sift_avx2:
      return avx2_kernels();
    case ck_sift_avx512:
      return avx512_kernels();
    case ck_sift_automatic:
      break;
  }
  return has_avx512() ? avx512_kernels() : has_avx2() ? avx2_kernels() : portable_kernels();
}

}  // namespace ck::sift

bool ck_sift_supported(ck_sift_instructions instructions) {
  switch (instructions) {
    case ck_sift_avx2:
      return ck::sift::has_avx2();
    case ck_sift_avx512:
      return ck::sift::has_avx512();
    case ck_sift_automatic:
    case ck_sift_portable:
      return true;
  }
  return false;
}
