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

}  // namespace ck
