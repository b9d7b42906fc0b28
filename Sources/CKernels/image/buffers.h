#pragma once

#include <cstdint>
#include <vector>

#include "ck_image.h"

/// Pixels, or other numbers, without padding, top row first.
struct ck_image {
  int32_t width = 0;
  int32_t height = 0;
  std::vector<uint8_t> pixels;
};

/// The bytes of a file or of a block of a file.
struct ck_bytes {
  std::vector<uint8_t> data;
};

namespace ck {

/// Throws if the size is empty or exceeds the limits.
void require_within(const ck_decode_limits& limits, int64_t width, int64_t height);

/// Decodes a JPEG to RGB with its sides divided by `reduction`; throws if pixel data is lost.
void decode_jpeg(const uint8_t* bytes, size_t count, int reduction, const ck_decode_limits& limits,
                 ck_image& image);

/// Decodes the primary image of a HEIF file to RGB.
void decode_heif(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                 ck_image& image);

/// Decodes the alpha channel; leaves the image without pixels if the file has none.
void decode_heif_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                       ck_image& image);

/// Encodes 8-bit gray, RGB or RGBA as PNG (ISO/IEC 15948) with libdeflate: four times as fast as
/// zlib at the file size of its level 6.
std::vector<uint8_t> encode_png(const uint8_t* pixels, int32_t width, int32_t height,
                                int32_t channels);

}  // namespace ck
