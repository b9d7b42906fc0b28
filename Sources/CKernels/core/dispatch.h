#pragma once

#include "core/instructions.h"

namespace ck {

/// The table of kernels that runs on this processor, of those compiled for each instruction set.
///
/// For files that are compiled without special instructions only.
template <typename Table>
const Table& dispatch(ck_instructions wish, const Table& (*portable)(), const Table& (*avx2)(),
                      const Table& (*avx512)()) {
  switch (chosen_instructions(wish)) {
    case ck_instructions_avx512_vnni:
    case ck_instructions_avx512:
      return avx512();
    case ck_instructions_avx2:
      return avx2();
    default:
      return portable();
  }
}

}  // namespace ck
