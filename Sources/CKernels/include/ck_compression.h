#ifndef CK_COMPRESSION_H
#define CK_COMPRESSION_H

#include "ck_core.h"
#include "ck_image.h"

#ifdef __cplusplus
extern "C" {
#endif

// Compression of vertices and triangles for the glTF extension EXT_meshopt_compression, by the
// library meshoptimizer.

/// Reorders the triangles of a primitive, and numbers its vertices in order of first use, so that
/// both compress well: triangles that share vertices become neighbors.
///
/// `indices` has three vertex indices per triangle. `ordered` receives as many, in the new
/// numbering; `new_from_old` receives the new number of each of the `vertex_count` vertices, and
/// `UINT32_MAX` for one without a triangle. Fails with `ck_invalid_argument` if an index is out of
/// range.
ck_status ck_order_triangles(const uint32_t* indices, size_t index_count, size_t vertex_count,
                             uint32_t* ordered, uint32_t* new_from_old);

/// Encodes `count` vertices of `stride` bytes each, a multiple of 4 up to 256: mode `ATTRIBUTES`.
/// The same vertices give the same bytes.
ck_status ck_encode_vertices(const uint8_t* vertices, size_t count, size_t stride,
                             ck_bytes** encoded);

/// Encodes triangles of `vertex_count` vertices: mode `TRIANGLES`. The corners of a triangle may be
/// rotated. Fails with `ck_invalid_argument` if an index is out of range.
ck_status ck_encode_triangles(const uint32_t* indices, size_t index_count, size_t vertex_count,
                              ck_bytes** encoded);

/// Decodes what `ck_encode_vertices` encodes; `vertices` receives `count × stride` bytes. Fails
/// with `ck_failed` if the bytes are damaged.
ck_status ck_decode_vertices(const uint8_t* bytes, size_t byte_count, size_t count, size_t stride,
                             uint8_t* vertices);

/// Decodes what `ck_encode_triangles` encodes. Fails with `ck_failed` if the bytes are damaged;
/// damage that is not detected gives arbitrary indices.
ck_status ck_decode_triangles(const uint8_t* bytes, size_t byte_count, size_t index_count,
                              uint32_t* indices);

/// Decodes, in place, `count` unit vectors of four bytes from the octahedral encoding: filter
/// `OCTAHEDRAL` with a stride of 4.
ck_status ck_decode_octahedral(uint8_t* vectors, size_t count);

#ifdef __cplusplus
}
#endif
#endif
