#include "core/instructions.h"

#include "core/guard.h"

bool ck_instructions_supported(ck_instructions instructions) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") &&
                          __builtin_cpu_supports("avx512bw") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  const bool has_vnni = has_avx512 && __builtin_cpu_supports("avx512vnni");
#else
  const bool has_avx2 = false, has_avx512 = false, has_vnni = false;
#endif
  switch (instructions) {
    case ck_instructions_automatic:
    case ck_instructions_portable:
      return true;
    case ck_instructions_avx2:
      return has_avx2;
    case ck_instructions_avx512:
      return has_avx512;
    case ck_instructions_avx512_vnni:
      return has_vnni;
  }
  return false;
}

ck_instructions ck::chosen_instructions(ck_instructions requested) {
  require(ck_instructions_supported(requested),
          "this processor doesn't support the requested instructions");
  if (requested != ck_instructions_automatic) return requested;
  for (ck_instructions set :
       {ck_instructions_avx512_vnni, ck_instructions_avx512, ck_instructions_avx2}) {
    if (ck_instructions_supported(set)) return set;
  }
  return ck_instructions_portable;
}
