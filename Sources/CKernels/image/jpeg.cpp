// jpeglib.h needs FILE and size_t declared.
#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

#include <jerror.h>

#include <string>

#include "core/guard.h"
#include "image/buffers.h"

namespace ck {
namespace {

/// Largest number of scans. Chosen: more than any camera writes; they would only occupy the
/// decoder.
constexpr int kMaximumScans = 100;

/// The error handler of a decoder, and what it has reported.
struct Errors {
  jpeg_error_mgr base;
  std::jmp_buf jump;
  char message[JMSG_LENGTH_MAX];
  bool damaged;
  unsigned damaged_row;
};

void on_error(j_common_ptr info) {
  auto* errors = reinterpret_cast<Errors*>(info->err);
  errors->base.format_message(info, errors->message);
  std::longjmp(errors->jump, 1);
}

/// Records warnings about lost pixels; stray bytes between segments lose none.
void on_message(j_common_ptr info, int level) {
  if (level >= 0 || !info->is_decompressor) return;
  auto* errors = reinterpret_cast<Errors*>(info->err);
  const int code = errors->base.msg_code;
  const bool lost = code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE ||
                    code == JWRN_MUST_RESYNC || code == JWRN_ARITH_BAD_CODE;
  if (!lost || errors->damaged) return;
  errors->damaged = true;
  errors->damaged_row = reinterpret_cast<j_decompress_ptr>(info)->output_scanline;
}

void on_progress(j_common_ptr info) {
  auto* decoder = reinterpret_cast<j_decompress_ptr>(info);
  if (decoder->input_scan_number > kMaximumScans) ERREXIT(info, JERR_BAD_PROGRESSION);
}

/// Converts CMYK to RGB. Adobe stores CMYK inverted: 255 is no ink.
void write_rgb_of_inverted_cmyk(const uint8_t* cmyk, size_t count, uint8_t* rgb) {
  for (size_t i = 0; i < count; ++i) {
    const unsigned k = cmyk[4 * i + 3];
    for (size_t c = 0; c < 3; ++c) {
      rgb[3 * i + c] = static_cast<uint8_t>((cmyk[4 * i + c] * k + 127) / 255);
    }
  }
}

/// Decodes the pixels; false with a message on an error. `longjmp` may leave this part, so it owns
/// nothing that needs a destructor; `row` is its buffer for a row of CMYK.
bool read(jpeg_decompress_struct& decoder, Errors& errors, const uint8_t* bytes, size_t count,
          int reduction, const ck_decode_limits& limits, ck_image& image,
          std::vector<uint8_t>& row) {
  if (setjmp(errors.jump)) return false;
  jpeg_mem_src(&decoder, bytes, static_cast<unsigned long>(count));
  jpeg_read_header(&decoder, TRUE);
  const int64_t full_width = decoder.image_width, full_height = decoder.image_height;
  if (full_width < 1 || full_height < 1 || full_width > limits.maximum_side ||
      full_height > limits.maximum_side || full_width * full_height > limits.maximum_pixels) {
    std::snprintf(errors.message, sizeof errors.message, "%lld × %lld pixels exceed the size limit",
                  static_cast<long long>(full_width), static_cast<long long>(full_height));
    return false;
  }
  const bool cmyk = decoder.jpeg_color_space == JCS_CMYK || decoder.jpeg_color_space == JCS_YCCK;
  decoder.out_color_space = cmyk ? JCS_CMYK : JCS_RGB;
  decoder.dct_method = JDCT_ISLOW;
  decoder.scale_num = 1;
  decoder.scale_denom = static_cast<unsigned>(reduction);
  jpeg_start_decompress(&decoder);
  const int64_t width = decoder.output_width, height = decoder.output_height;
  image.width = static_cast<int32_t>(width);
  image.height = static_cast<int32_t>(height);
  image.pixels.resize(static_cast<size_t>(width * height) * 3);
  row.resize(static_cast<size_t>(width) * (cmyk ? 4 : 3));
  while (decoder.output_scanline < decoder.output_height) {
    uint8_t* target = image.pixels.data() + size_t{decoder.output_scanline} * width * 3;
    uint8_t* line = cmyk ? row.data() : target;
    if (jpeg_read_scanlines(&decoder, &line, 1) != 1) break;
    if (cmyk) {
      if (!decoder.saw_Adobe_marker) {
        for (auto& value : row) value = static_cast<uint8_t>(255 - value);
      }
      write_rgb_of_inverted_cmyk(row.data(), static_cast<size_t>(width), target);
    }
  }
  jpeg_finish_decompress(&decoder);
  return true;
}

}  // namespace

void decode_jpeg(const uint8_t* bytes, size_t count, int reduction, const ck_decode_limits& limits,
                 ck_image& image) {
  jpeg_decompress_struct decoder{};
  Errors errors{};
  jpeg_progress_mgr progress{};
  std::vector<uint8_t> row;
  decoder.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = on_error;
  errors.base.emit_message = on_message;
  jpeg_create_decompress(&decoder);
  progress.progress_monitor = on_progress;
  decoder.progress = &progress;
  bool complete = false;
  try {
    complete = read(decoder, errors, bytes, count, reduction, limits, image, row);
  } catch (...) {
    jpeg_destroy_decompress(&decoder);
    throw;
  }
  jpeg_destroy_decompress(&decoder);
  if (!complete) throw std::runtime_error(errors.message);
  if (errors.damaged) {
    throw std::runtime_error("its pixel data is damaged or truncated from row " +
                             std::to_string(errors.damaged_row) + " of " +
                             std::to_string(image.height));
  }
}

}  // namespace ck
