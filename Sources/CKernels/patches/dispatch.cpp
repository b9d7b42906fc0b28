#include "core/instructions.h"
#include "patches/grid.h"

const ck::patches::Kernels& ck::patches::kernels(ck_instructions wish) {
  switch (chosen_instructions(wish)) {
    case ck_instructions_avx512_vnni:
    case ck_instructions_avx512:
      return avx512_kernels();
    case ck_instructions_avx2:
      return avx2_kernels();
    default:
      return portable_kernels();
  }
}
