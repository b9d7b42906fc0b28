#pragma once

#include <libheif/heif.h>

#include <memory>
#include <new>
#include <stdexcept>

#include "core/guard.h"

namespace ck::heif {

/// Deleter that calls a function of libheif.
template <auto free>
struct Free {
  template <typename T>
  void operator()(T* value) const {
    free(value);
  }
};

using Context = std::unique_ptr<heif_context, Free<heif_context_free>>;
using Handle = std::unique_ptr<heif_image_handle, Free<heif_image_handle_release>>;
using Image = std::unique_ptr<heif_image, Free<heif_image_release>>;
using DecodingOptions = std::unique_ptr<heif_decoding_options, Free<heif_decoding_options_free>>;

/// Throws the error that libheif reports: `std::invalid_argument` if it has no codec for the file.
inline void check(const heif_error& error) {
  if (error.code == heif_error_Ok) return;
  if (error.code == heif_error_Memory_allocation_error) throw std::bad_alloc();
  const bool lacks_codec =
      error.code == heif_error_Unsupported_filetype || error.code == heif_error_Unsupported_feature;
  if (lacks_codec) throw std::invalid_argument(error.message);
  throw std::runtime_error(error.message);
}

/// An empty context that decodes on the calling thread.
inline Context make_context() {
  Context context(heif_context_alloc());
  if (!context) throw std::bad_alloc();
  // Photos are decoded concurrently; tiles need no additional threads.
  heif_context_set_max_decoding_threads(context.get(), 0);
  return context;
}

/// Options that convert samples to 8 bits and fail at damage.
inline DecodingOptions make_decoding_options() {
  DecodingOptions options(heif_decoding_options_alloc());
  if (!options) throw std::bad_alloc();
  options->convert_hdr_to_8bit = 1;
  options->strict_decoding = 1;
  return options;
}

/// The primary image of a file; `bytes` must outlive it.
struct Primary {
  Context context = make_context();
  Handle handle;

  Primary(const uint8_t* bytes, size_t count) {
    require(bytes && count > 0, "the file is empty");
    check(heif_context_read_from_memory_without_copy(context.get(), bytes, count, nullptr));
    heif_image_handle* primary = nullptr;
    check(heif_context_get_primary_image_handle(context.get(), &primary));
    handle.reset(primary);
  }

  int width() const { return heif_image_handle_get_width(handle.get()); }
  int height() const { return heif_image_handle_get_height(handle.get()); }
  bool has_alpha() const { return heif_image_handle_has_alpha_channel(handle.get()); }
};

}  // namespace ck::heif
