#include <png.h>

#include <cstring>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/guard.h"
#include "core/opencv.h"
#include "image/buffers.h"

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

void decode_other(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                  ck_image& image) {
  require(count <= static_cast<size_t>(INT32_MAX), "the file is too large");
  const cv::Mat data(1, static_cast<int>(count), CV_8U, const_cast<uint8_t*>(bytes));
  const cv::Mat bgr = cv::imdecode(data, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (bgr.empty() || bgr.type() != CV_8UC3) throw std::runtime_error("it can't be decoded");
  require_within(limits, bgr.cols, bgr.rows);
  image.width = bgr.cols;
  image.height = bgr.rows;
  image.pixels.resize(bgr.total() * 3);
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, image.pixels.data());
  on_one_thread([&] { cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB); });
}

/// Decodes the alpha channel; leaves the image without pixels if the file has none.
void decode_other_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                        ck_image& image) {
  require(count <= static_cast<size_t>(INT32_MAX), "the file is too large");
  const cv::Mat data(1, static_cast<int>(count), CV_8U, const_cast<uint8_t*>(bytes));
  const cv::Mat all = cv::imdecode(data, cv::IMREAD_UNCHANGED);
  if (all.empty()) throw std::runtime_error("it can't be decoded");
  require_within(limits, all.cols, all.rows);
  if (all.channels() != 4 || (all.depth() != CV_8U && all.depth() != CV_16U)) return;
  image.width = all.cols;
  image.height = all.rows;
  image.pixels.resize(all.total());
  cv::Mat alpha, bytes_of_alpha(all.rows, all.cols, CV_8U, image.pixels.data());
  cv::extractChannel(all, alpha, 3);
  alpha.convertTo(bytes_of_alpha, CV_8U, all.depth() == CV_16U ? 1 / 257.0 : 1);
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
      default:
        ck::decode_other(bytes, byte_count, *limits, *result);
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
    if (codec == ck_codec_other) ck::decode_other_alpha(bytes, byte_count, *limits, *result);
    *image = result.release();
  });
}

ck_status ck_image_decode_float(const uint8_t* bytes, size_t byte_count,
                                const ck_decode_limits* limits, ck_image** image) {
  return ck::guarded([&] {
    ck::require(bytes && byte_count > 0, "the file is empty");
    ck::require(byte_count <= static_cast<size_t>(INT32_MAX), "the file is too large");
    const cv::Mat data(1, static_cast<int>(byte_count), CV_8U, const_cast<uint8_t*>(bytes));
    const cv::Mat decoded = cv::imdecode(data, cv::IMREAD_UNCHANGED);
    if (decoded.empty()) throw std::runtime_error("it can't be decoded");
    ck::require_within(*limits, decoded.cols, decoded.rows);
    auto result = std::make_unique<ck_image>();
    if (decoded.type() == CV_32FC1) {
      result->width = decoded.cols;
      result->height = decoded.rows;
      result->pixels.resize(decoded.total() * sizeof(float));
      std::memcpy(result->pixels.data(), decoded.ptr(), result->pixels.size());
    }
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
    if (codec == ck_codec_png) {
      result->data = ck::encode_png(data, width, height, channels);
    } else {
      const cv::Mat source(height, width, CV_8UC(channels), const_cast<uint8_t*>(data));
      // A separate matrix: OpenCV would write into an existing one of the same size.
      cv::Mat swapped;
      if (channels == 3) {
        ck::on_one_thread([&] { cv::cvtColor(source, swapped, cv::COLOR_RGB2BGR); });
      } else {
        swapped = source;
      }
      const std::vector<int> options{cv::IMWRITE_JPEG_QUALITY, quality, cv::IMWRITE_JPEG_OPTIMIZE,
                                     1};
      if (!cv::imencode(".jpg", swapped, result->data, options)) {
        throw std::runtime_error("the image can't be encoded");
      }
    }
    *encoded = result.release();
  });
}

size_t ck_bytes_count(const ck_bytes* bytes) { return bytes->data.size(); }
void ck_bytes_copy(const ck_bytes* bytes, uint8_t* destination) {
  std::memcpy(destination, bytes->data.data(), bytes->data.size());
}
void ck_bytes_free(ck_bytes* bytes) { delete bytes; }
