#pragma once

#include "ck_core.h"

namespace ck {

// Nothing here is inline: a file compiled for one of the sets must not emit the code that asks
// whether the processor has it.

/// The instructions to run: those wished for, or the last set that this processor has where the
/// wish is automatic. Throws where the processor lacks them.
ck_instructions chosen_instructions(ck_instructions wish);

}  // namespace ck
