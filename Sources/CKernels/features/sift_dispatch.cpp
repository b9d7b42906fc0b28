#include "core/instructions.h"
#include "features/scale_space.h"

const ck::sift::Kernels& ck::sift::kernels(ck_instructions wish) {
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
