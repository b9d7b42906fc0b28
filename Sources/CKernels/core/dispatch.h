#pragma once

#include "core/instructions.h"

namespace ck {

/// Selects the kernel table for this processor among those compiled for each instruction set.
///
/// Only for files that are compiled without special instructions.
template <typename Table>
const Table& dispatch(ck_instructions requested, const Table& (*portable)(), const Table& (*avx2)(),
                      const Table& (*avx512)()) {
  switch (chosen_instructions(requested)) {
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
