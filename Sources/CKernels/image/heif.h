#pragma once

#include <libheif/heif.h>

#include <memory>
#include <new>
#include <stdexcept>

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

}  // namespace ck::heif
