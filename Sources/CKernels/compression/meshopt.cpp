#include <meshoptimizer.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "ck_compression.h"
#include "core/guard.h"
#include "image/buffers.h"

namespace ck {
namespace {

/// The library only asserts what it requires, and asserts are compiled out.
void require_triangles(const uint32_t* indices, size_t index_count, size_t vertex_count) {
  require(index_count % 3 == 0, "the number of indices is not a multiple of three");
  require(std::all_of(indices, indices + index_count, [=](auto i) { return i < vertex_count; }),
          "a triangle refers to a vertex that does not exist");
}

void require_stride(size_t stride) {
  require(stride > 0 && stride <= 256 && stride % 4 == 0,
          "vertices need a multiple of four bytes, up to 256");
}

/// Limit: the first byte of compressed triangles in version 1 of the format, which the glTF
/// extension prescribes.
constexpr uint8_t triangles_version_1 = 0xe1;

/// Selects version 1, once: the library's default is 0, and the version is a variable of the
/// library, which affects only this encoder. If other code of the process changes it, encoding
/// fails.
void select_version() {
  // Limit: the version that the glTF extension prescribes.
  static const bool is_selected = (meshopt_encodeIndexVersion(1), true);
  static_cast<void>(is_selected);
}

}  // namespace
}  // namespace ck

ck_status ck_order_triangles(const uint32_t* indices, size_t index_count, size_t vertex_count,
                             uint32_t* ordered, uint32_t* new_from_old) {
  return ck::guarded([&] {
    ck::require_triangles(indices, index_count, vertex_count);
    meshopt_optimizeVertexCacheStrip(ordered, indices, index_count, vertex_count);
    meshopt_optimizeVertexFetchRemap(new_from_old, ordered, index_count, vertex_count);
    meshopt_remapIndexBuffer(ordered, ordered, index_count, new_from_old);
  });
}

ck_status ck_encode_vertices(const uint8_t* vertices, size_t count, size_t stride,
                             ck_bytes** encoded) {
  return ck::guarded([&] {
    ck::require_stride(stride);
    auto result = std::make_unique<ck_bytes>();
    auto& data = result->data;
    data.resize(meshopt_encodeVertexBufferBound(count, stride));
    data.resize(meshopt_encodeVertexBuffer(data.data(), data.size(), vertices, count, stride));
    if (data.empty()) throw std::runtime_error("the vertices can't be compressed");
    *encoded = result.release();
  });
}

ck_status ck_encode_triangles(const uint32_t* indices, size_t index_count, size_t vertex_count,
                              ck_bytes** encoded) {
  return ck::guarded([&] {
    ck::require_triangles(indices, index_count, vertex_count);
    ck::select_version();
    auto result = std::make_unique<ck_bytes>();
    auto& data = result->data;
    data.resize(meshopt_encodeIndexBufferBound(index_count, vertex_count));
    data.resize(meshopt_encodeIndexBuffer(data.data(), data.size(), indices, index_count));
    if (data.empty() || data[0] != ck::triangles_version_1) {
      throw std::runtime_error("the triangles can't be compressed");
    }
    *encoded = result.release();
  });
}

ck_status ck_decode_vertices(const uint8_t* bytes, size_t byte_count, size_t count, size_t stride,
                             uint8_t* vertices) {
  return ck::guarded([&] {
    ck::require_stride(stride);
    if (meshopt_decodeVertexBuffer(vertices, count, stride, bytes, byte_count) != 0) {
      throw std::runtime_error("the compressed vertices are damaged");
    }
  });
}

ck_status ck_decode_triangles(const uint8_t* bytes, size_t byte_count, size_t index_count,
                              uint32_t* indices) {
  return ck::guarded([&] {
    ck::require(index_count % 3 == 0, "the number of indices is not a multiple of three");
    if (meshopt_decodeIndexBuffer(indices, index_count, 4, bytes, byte_count) != 0) {
      throw std::runtime_error("the compressed triangles are damaged");
    }
  });
}

ck_status ck_decode_octahedral(uint8_t* vectors, size_t count) {
  return ck::guarded([&] {
    // The library decodes multiples of four vectors.
    const size_t whole = count & ~size_t{3};
    meshopt_decodeFilterOct(vectors, whole, 4);
    uint8_t rest[16] = {};
    std::copy(vectors + 4 * whole, vectors + 4 * count, rest);
    meshopt_decodeFilterOct(rest, 4, 4);
    std::copy(rest, rest + 4 * (count - whole), vectors + 4 * whole);
  });
}
