#pragma once

#include "image/buffers.h"

// Camera raw files, read by LibRaw. Compiled with PHOTOGRAMMETRY_WITHOUT_RAW, `raw.cpp` doesn't
// need the library: its functions then throw `LeftOut`.

namespace ck {

/// Reads the properties of a camera raw file.
void inspect_raw(const uint8_t* bytes, size_t count, ck_raw_info& info);

/// Decodes a camera raw file to RGB, upright.
void decode_raw(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                ck_image& image);

}  // namespace ck
