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

/// Decodes the first image of a TIFF file to RGB, upright.
void decode_tiff(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                 ck_image& image);

/// Decodes the alpha channel, upright; leaves the image without pixels if the file has none.
void decode_tiff_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                       ck_image& image);

/// Decodes one 32-bit floating-point number per pixel, upright; leaves the image without pixels if
/// the file has another pixel format.
void decode_tiff_numbers(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                         ck_image& image);

/// Decodes a WebP file to RGB; throws for an animation.
void decode_webp(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                 ck_image& image);

/// Decodes the alpha channel; leaves the image without pixels if the file has none.
void decode_webp_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                       ck_image& image);

/// Decodes a Windows bitmap of 8, 24 or 32 bits per pixel without compression to RGB.
void decode_bmp(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                ck_image& image);

/// Decodes the primary image of a HEIF file to RGB.
void decode_heif(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                 ck_image& image);

/// Decodes the alpha channel; leaves the image without pixels if the file has none.
void decode_heif_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                       ck_image& image);

/// Rotates pixels upright by an EXIF orientation of 1…8.
void turn_upright(const ck_pixels& source, int32_t orientation,
                  const ck_mutable_pixels& destination);

/// Encodes 8-bit gray or RGB as JPEG with Huffman tables of its own; `quality` is 0…100.
std::vector<uint8_t> encode_jpeg(const ck_pixels& pixels, int quality);

/// Encodes 8-bit gray, RGB or RGBA as PNG (ISO/IEC 15948) with libdeflate: four times as fast as
/// zlib at the file size of its level 6.
std::vector<uint8_t> encode_png(const uint8_t* pixels, int32_t width, int32_t height,
                                int32_t channels);

}  // namespace ck
