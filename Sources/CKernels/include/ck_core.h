#ifndef CK_CORE_H
#define CK_CORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Status of a kernel call. Unless it is `ck_ok`, the contents of the outputs are unspecified.
typedef enum {
  ck_ok = 0,
  /// `should_continue` returned false.
  ck_canceled = 1,
  /// A pointer is null, a value is out of range, or two arguments contradict each other.
  ck_invalid_argument = 2,
  /// The input is valid but does not determine a result.
  ck_degenerate = 3,
  /// Any other failure: a damaged file, or an error of a library.
  ck_failed = 4,
  /// Memory allocation failed; a later call with the same input may succeed.
  ck_out_of_memory = 5,
  /// This program was built without the library that the call needs.
  ck_left_out = 6,
} ck_status;

/// Reports progress and queries cancellation. May be called from any thread.
typedef struct {
  void* context;
  /// `fraction` is in 0…1. Returns false to cancel the kernel.
  bool (*should_continue)(void* context, double fraction);
  /// Number of threads the kernel may use, at least 1. Results do not depend on it.
  int32_t threads;
} ck_control;

/// `count` elements, one every `stride` bytes; `data` may be null if there are none.
///
/// The function that takes a span specifies its element type.
typedef struct {
  const void* data;
  size_t count;
  size_t stride;
} ck_span;

/// A span that a kernel writes to.
typedef struct {
  void* data;
  size_t count;
  size_t stride;
} ck_mutable_span;

/// 8-bit pixels, top row first, channels interleaved, `row_stride` bytes from one row to the next.
typedef struct {
  const uint8_t* data;
  /// Size in pixels.
  int32_t width, height;
  /// 1: gray, 3: RGB, 4: RGBA.
  int32_t channels;
  size_t row_stride;
} ck_pixels;

/// 8-bit pixels that a kernel writes, in the same layout but without padding between rows.
typedef struct {
  uint8_t* data;
  int32_t width, height;
  int32_t channels;
} ck_mutable_pixels;

/// Instruction sets that a kernel may use; each includes those listed before it.
typedef enum {
  /// The most capable set that the processor supports.
  ck_instructions_automatic = 0,
  /// The baseline of the architecture.
  ck_instructions_portable = 1,
  /// AVX2 and FMA.
  ck_instructions_avx2 = 2,
  /// AVX-512 F, BW, DQ and VL.
  ck_instructions_avx512 = 3,
  /// AVX-512 VNNI: dot products of bytes.
  ck_instructions_avx512_vnni = 4,
} ck_instructions;

/// Whether this processor supports the instruction set; always true for the automatic choice.
bool ck_instructions_supported(ck_instructions instructions);

/// Description of the error of the last call on this thread that did not return `ck_ok`.
///
/// Valid until the next kernel call on the same thread.
const char* ck_last_error(void);

/// The XXH64 hash (Y. Collet): the same in every run and on every machine. It detects accidental
/// changes, not forgery.
uint64_t ck_hash(const void* bytes, size_t count, uint64_t seed);

/// The libraries that are linked, one per line: name, space, version.
const char* ck_library_versions(void);

/// The JavaScript library of the report's page, if the program was linked with it; else empty.
ck_span ck_viewer_bundle(void);

/// Returns free memory of the C library's allocator to the system, where it can.
void ck_release_free_memory(void);

/// Suppresses the messages of OpenCV, and everything that C++ code writes to `std::cerr`,
/// and limits OpenCV to one thread, for the whole process.
///
/// To be called once from the `main` of an executable, before the first kernel: kernels themselves
/// do not change settings of the process.
void ck_silence_libraries(void);

#ifdef __cplusplus
}
#endif
#endif
