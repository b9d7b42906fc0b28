#include <png.h>

#include <cstring>
#include <memory>

#include "core/guard.h"
#include "image/buffers.h"
#include "image/exr.h"
#include "image/raw.h"

namespace ck {

void require_within(const ck_decode_limits& limits, int64_t width, int64_t height) {
  require(width > 0 && height > 0, "the image has no pixels");
  require(width <= limits.maximum_side && height <= limits.maximum_side &&
              width * height <= limits.maximum_pixels,
          "the image has too many pixels");
}

namespace {

/// Reads all pixels of a PNG as RGBA, which preserves the color of transparent pixels, whereas RGB
/// would composite them with a background; `image` receives the size.
std::vector<uint8_t> read_png(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                              ck_image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  struct Free {
    png_image* png;
    ~Free() { png_image_free(png); }
  } free_at_end{&png};
  if (!png_image_begin_read_from_memory(&png, bytes, count)) {
    throw std::runtime_error(png.message);
  }
  require_within(limits, png.width, png.height);
  png.format = PNG_FORMAT_RGBA;
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  std::vector<uint8_t> rgba(PNG_IMAGE_SIZE(png));
  if (!png_image_finish_read(&png, nullptr, rgba.data(), 0, nullptr)) {
    throw std::runtime_error(png.message);
  }
  image.width = static_cast<int32_t>(png.width);
  image.height = static_cast<int32_t>(png.height);
  return rgba;
}

void decode_png(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                ck_image& image) {
  const std::vector<uint8_t> rgba = read_png(bytes, count, limits, image);
  image.pixels.resize(rgba.size() / 4 * 3);
  for (size_t i = 0; i < rgba.size() / 4; ++i) {
    std::memcpy(&image.pixels[3 * i], &rgba[4 * i], 3);
  }
}

void decode_png_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                      ck_image& image) {
  const std::vector<uint8_t> rgba = read_png(bytes, count, limits, image);
  image.pixels.resize(rgba.size() / 4);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = rgba[4 * i + 3];
}

}  // namespace
}  // namespace ck

ck_status ck_image_decode(const uint8_t* bytes, size_t byte_count, ck_codec codec,
                          int32_t reduction, const ck_decode_limits* limits, ck_image** image) {
  return ck::guarded([&] {
    ck::require(bytes && byte_count > 0, "the file is empty");
    ck::require(reduction == 1 || reduction == 2 || reduction == 4 || reduction == 8,
                "the reduction must be 1, 2, 4 or 8");
    auto result = std::make_unique<ck_image>();
    switch (codec) {
      case ck_codec_jpeg:
        ck::decode_jpeg(bytes, byte_count, reduction, *limits, *result);
        break;
      case ck_codec_png:
        ck::decode_png(bytes, byte_count, *limits, *result);
        break;
      case ck_codec_heif:
        ck::decode_heif(bytes, byte_count, *limits, *result);
        break;
      case ck_codec_tiff:
        ck::decode_tiff(bytes, byte_count, *limits, *result);
        break;
      case ck_codec_webp:
        ck::decode_webp(bytes, byte_count, *limits, *result);
        break;
      case ck_codec_bmp:
        ck::decode_bmp(bytes, byte_count, *limits, *result);
        break;
      case ck_codec_raw:
        ck::decode_raw(bytes, byte_count, *limits, *result);
        break;
      case ck_codec_exr:
        ck::decode_exr(bytes, byte_count, *limits, *result);
        break;
    }
    *image = result.release();
  });
}

ck_status ck_image_decode_alpha(const uint8_t* bytes, size_t byte_count, ck_codec codec,
                                const ck_decode_limits* limits, ck_image** image) {
  return ck::guarded([&] {
    ck::require(bytes && byte_count > 0, "the file is empty");
    auto result = std::make_unique<ck_image>();
    if (codec == ck_codec_png) ck::decode_png_alpha(bytes, byte_count, *limits, *result);
    if (codec == ck_codec_heif) ck::decode_heif_alpha(bytes, byte_count, *limits, *result);
    if (codec == ck_codec_tiff) ck::decode_tiff_alpha(bytes, byte_count, *limits, *result);
    if (codec == ck_codec_webp) ck::decode_webp_alpha(bytes, byte_count, *limits, *result);
    if (codec == ck_codec_exr) ck::decode_exr_alpha(bytes, byte_count, *limits, *result);
    *image = result.release();
  });
}

ck_status ck_image_decode_float(const uint8_t* bytes, size_t byte_count, ck_codec codec,
                                const ck_decode_limits* limits, ck_image** image) {
  return ck::guarded([&] {
    ck::require(bytes && byte_count > 0, "the file is empty");
    auto result = std::make_unique<ck_image>();
    if (codec == ck_codec_tiff) ck::decode_tiff_numbers(bytes, byte_count, *limits, *result);
    if (codec == ck_codec_exr) ck::decode_exr_numbers(bytes, byte_count, *limits, *result);
    *image = result.release();
  });
}

int32_t ck_image_width(const ck_image* image) { return image->width; }
int32_t ck_image_height(const ck_image* image) { return image->height; }
void ck_image_copy(const ck_image* image, uint8_t* destination) {
  std::memcpy(destination, image->pixels.data(), image->pixels.size());
}
void ck_image_free(ck_image* image) { delete image; }

ck_status ck_image_encode(const ck_pixels* pixels, ck_codec codec, int32_t quality,
                          ck_bytes** encoded) {
  return ck::guarded([&] {
    const auto [data, width, height, channels, row_stride] = *pixels;
    ck::require(width > 0 && height > 0, "an image without pixels can't be encoded");
    ck::require(row_stride == static_cast<size_t>(width) * channels, "rows have padding");
    ck::require(channels == 1 || channels == 3 || (channels == 4 && codec == ck_codec_png),
                "this number of channels can't be encoded");
    auto result = std::make_unique<ck_bytes>();
    result->data = codec == ck_codec_png ? ck::encode_png(data, width, height, channels)
                                         : ck::encode_jpeg(*pixels, quality);
    *encoded = result.release();
  });
}

size_t ck_bytes_count(const ck_bytes* bytes) { return bytes->data.size(); }
void ck_bytes_copy(const ck_bytes* bytes, uint8_t* destination) {
  std::memcpy(destination, bytes->data.data(), bytes->data.size());
}
void ck_bytes_free(ck_bytes* bytes) { delete bytes; }
