#include <libdeflate.h>

#include <memory>
#include <new>

#include "core/guard.h"
#include "image/buffers.h"

ck_status ck_inflate(const uint8_t* bytes, size_t byte_count, size_t maximum_count,
                     ck_bytes** inflated) {
  return ck::guarded([&] {
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (!decompressor) throw std::bad_alloc();
    auto result = std::make_unique<ck_bytes>();
    result->data.resize(maximum_count);
    size_t count = 0;
    const libdeflate_result fault = libdeflate_zlib_decompress(
        decompressor.get(), bytes, byte_count, result->data.data(), maximum_count, &count);
    if (fault != LIBDEFLATE_SUCCESS) throw std::runtime_error("it can't be inflated");
    result->data.resize(count);
    *inflated = result.release();
  });
}
