#pragma once

#include "ck_core.h"

namespace ck {

// Nothing here is inline: a file compiled for one of the instruction sets must not emit the code
// that tests whether the processor supports it.

/// The instruction set to use: the requested one, or the most capable one of this processor if
/// automatic was requested. Throws if the processor does not support it.
ck_instructions chosen_instructions(ck_instructions requested);

}  // namespace ck
