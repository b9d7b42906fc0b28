#pragma once

#include "image/buffers.h"

// OpenEXR images, read by OpenEXRCore. Compiled with PHOTOGRAMMETRY_WITHOUT_EXR, `exr.cpp` doesn't
// need the library: its functions then throw `LeftOut`.

namespace ck {

/// Reads the header of an OpenEXR file.
void inspect_exr(const uint8_t* bytes, size_t count, ck_exr_info& info);

/// Decodes the colors or the luminance of an OpenEXR file to RGB.
void decode_exr(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                ck_image& image);

/// Decodes the alpha channel; leaves the image without pixels if the file has none.
void decode_exr_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                      ck_image& image);

/// Decodes one 32-bit floating-point number per pixel; leaves the image without pixels if the file
/// has several channels.
void decode_exr_numbers(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                        ck_image& image);

}  // namespace ck
