#include "core/dispatch.h"
#include "features/scale_space.h"

const ck::sift::Kernels& ck::sift::kernels(ck_instructions requested) {
  return dispatch(requested, portable_kernels, avx2_kernels, avx512_kernels);
}
