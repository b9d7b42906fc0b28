#pragma once

#include <cstdint>

// Values of these types never cross a call boundary: all functions that take or return them are
// inlined.
#pragma clang diagnostic ignored "-Wpsabi"

namespace ck {

// Vector types named by the type of their lanes (float, signed, unsigned, half word, byte) and
// their number; the compiler maps them to the registers of the target.
typedef float F16 __attribute__((ext_vector_type(16)));
typedef float F8 __attribute__((ext_vector_type(8)));
typedef float F4 __attribute__((ext_vector_type(4)));
typedef int32_t I16 __attribute__((ext_vector_type(16)));
typedef int32_t I8 __attribute__((ext_vector_type(8)));
typedef uint32_t U16 __attribute__((ext_vector_type(16)));
typedef uint16_t H16 __attribute__((ext_vector_type(16)));
typedef uint8_t B16 __attribute__((ext_vector_type(16)));

#define CK_INLINE inline __attribute__((always_inline))

}  // namespace ck
