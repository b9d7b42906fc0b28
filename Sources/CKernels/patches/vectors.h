#pragma once

#include <cstdint>

// Values of these types never cross a call: all functions that take or return them are inlined.
#pragma clang diagnostic ignored "-Wpsabi"

namespace ck::patches {

/// Sixteen lanes; the compiler maps them to what the target has.
typedef float F16 __attribute__((ext_vector_type(16)));
typedef int32_t I16 __attribute__((ext_vector_type(16)));

}  // namespace ck::patches
