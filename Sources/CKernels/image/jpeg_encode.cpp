// jpeglib.h needs FILE and size_t declared.
#include <csetjmp>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

#include <memory>

#include "core/guard.h"
#include "image/buffers.h"

namespace ck {
namespace {

struct Errors {
  jpeg_error_mgr base;
  std::jmp_buf jump;
  char message[JMSG_LENGTH_MAX];
};

void on_error(j_common_ptr info) {
  auto* errors = reinterpret_cast<Errors*>(info->err);
  errors->base.format_message(info, errors->message);
  std::longjmp(errors->jump, 1);
}

void on_message(j_common_ptr, int) {}

/// Encodes the pixels; false with a message on an error. `longjmp` may leave this part, so it owns
/// nothing that needs a destructor.
bool write(jpeg_compress_struct& encoder, Errors& errors, const ck_pixels& pixels, int quality,
           unsigned char** file, unsigned long* count) {
  if (setjmp(errors.jump)) return false;
  jpeg_mem_dest(&encoder, file, count);
  encoder.image_width = static_cast<unsigned>(pixels.width);
  encoder.image_height = static_cast<unsigned>(pixels.height);
  encoder.input_components = pixels.channels;
  encoder.in_color_space = pixels.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, quality, TRUE);
  encoder.optimize_coding = TRUE;
  jpeg_start_compress(&encoder, TRUE);
  while (encoder.next_scanline < encoder.image_height) {
    auto* row = const_cast<uint8_t*>(pixels.data + encoder.next_scanline * pixels.row_stride);
    jpeg_write_scanlines(&encoder, &row, 1);
  }
  jpeg_finish_compress(&encoder);
  return true;
}

}  // namespace

std::vector<uint8_t> encode_jpeg(const ck_pixels& pixels, int quality) {
  jpeg_compress_struct encoder{};
  Errors errors{};
  unsigned char* file = nullptr;
  unsigned long count = 0;
  encoder.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = on_error;
  errors.base.emit_message = on_message;
  jpeg_create_compress(&encoder);
  const bool complete = write(encoder, errors, pixels, quality, &file, &count);
  jpeg_destroy_compress(&encoder);
  // Until the file is complete, libjpeg may have freed the memory that `file` refers to.
  if (!complete) throw std::runtime_error(errors.message);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(file, std::free);
  return std::vector<uint8_t>(file, file + count);
}

}  // namespace ck
