#pragma once

#include <cstdint>
#include <vector>

#include "ck_image.h"

struct ck_image {
  int32_t width = 0;
  int32_t height = 0;
  std::vector<uint8_t> pixels;
};

struct ck_bytes {
  std::vector<uint8_t> data;
};

namespace ck {

/// Throws unless an image of this size may be decoded.
void require_within(const ck_decode_limits& limits, int64_t width, int64_t height);

void decode_jpeg(const uint8_t* bytes, size_t count, int reduction, const ck_decode_limits& limits,
                 ck_image& image);

void decode_heif(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                 ck_image& image);

/// Leaves the image without pixels where the file has no alpha channel.
void decode_heif_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                       ck_image& image);

/// A PNG file (ISO/IEC 15948) of 8-bit gray, RGB or RGBA, compressed with libdeflate: four times as
/// fast as zlib at the size of its level 6.
std::vector<uint8_t> encode_png(const uint8_t* pixels, int32_t width, int32_t height,
                                int32_t channels);

}  // namespace ck
