#include "core/dispatch.h"
#include "patches/grid.h"

const ck::patches::Kernels& ck::patches::kernels(ck_instructions requested) {
  return dispatch(requested, portable_kernels, avx2_kernels, avx512_kernels);
}
