#include <webp/decode.h>

#include "core/guard.h"
#include "image/buffers.h"

namespace ck {
namespace {

/// Reads the header.
WebPBitstreamFeatures inspect(const uint8_t* bytes, size_t count, const ck_decode_limits& limits) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes, count, &features) != VP8_STATUS_OK) {
    throw std::runtime_error("its header is damaged");
  }
  require(!features.has_animation, "it is an animation");
  require_within(limits, features.width, features.height);
  return features;
}

using Decoder = uint8_t* (*)(const uint8_t* bytes, size_t count, uint8_t* pixels, size_t size,
                             int row_stride);

/// Decodes to `channels` bytes per pixel with the function of libwebp for them.
std::vector<uint8_t> decoded(const uint8_t* bytes, size_t count, int width, int height,
                             int channels, Decoder decode) {
  const size_t row = static_cast<size_t>(width) * channels;
  std::vector<uint8_t> pixels(row * static_cast<size_t>(height));
  if (!decode(bytes, count, pixels.data(), pixels.size(), static_cast<int>(row))) {
    throw std::runtime_error("its pixel data is damaged or truncated");
  }
  return pixels;
}

}  // namespace

void decode_webp(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                 ck_image& image) {
  const auto features = inspect(bytes, count, limits);
  image.width = features.width;
  image.height = features.height;
  image.pixels = decoded(bytes, count, image.width, image.height, 3, WebPDecodeRGBInto);
}

void decode_webp_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                       ck_image& image) {
  const auto features = inspect(bytes, count, limits);
  if (!features.has_alpha) return;
  image.width = features.width;
  image.height = features.height;
  const std::vector<uint8_t> rgba =
      decoded(bytes, count, image.width, image.height, 4, WebPDecodeRGBAInto);
  image.pixels.resize(rgba.size() / 4);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = rgba[4 * i + 3];
}

}  // namespace ck
