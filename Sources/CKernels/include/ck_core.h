#ifndef CK_CORE_H
#define CK_CORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// How a kernel call ended.
typedef enum {
  ck_ok = 0,
  ck_cancelled = 1,
  ck_invalid_argument = 2,
  /// The input is valid but does not determine a result.
  ck_degenerate = 3,
  ck_failed = 4,
  /// There was too little memory, which may be otherwise at another time.
  ck_out_of_memory = 5,
} ck_status;

/// Reports progress and asks whether to go on. May be called from any thread.
typedef struct {
  void* context;
  /// `fraction` runs from 0 to 1. Returns false to cancel the kernel.
  bool (*should_continue)(void* context, double fraction);
  /// Threads the kernel may use, at least 1. Results do not depend on it.
  int32_t threads;
} ck_control;

/// Sets of instructions that a kernel may use, each with all of those before it.
typedef enum {
  /// The last of these that the processor has.
  ck_instructions_automatic = 0,
  /// What every processor of the architecture has.
  ck_instructions_portable = 1,
  /// AVX2 and FMA.
  ck_instructions_avx2 = 2,
  /// AVX-512 F, BW, DQ and VL.
  ck_instructions_avx512 = 3,
  /// The products of bytes of AVX-512 VNNI.
  ck_instructions_avx512_vnni = 4,
} ck_instructions;

/// Whether this processor has the instructions; always true of automatic ones.
bool ck_instructions_supported(ck_instructions instructions);

/// What went wrong in the last call on this thread that did not return `ck_ok`.
///
/// Valid until the next kernel call on the same thread.
const char* ck_last_error(void);

/// The XXH64 hash of some bytes (Y. Collet): the same in every run and on every machine. It tells
/// changed bytes, not forged ones.
uint64_t ck_hash(const void* bytes, size_t count, uint64_t seed);

/// Redirects the messages of OpenCV, glog and Open3D away from the terminal. Call once.
void ck_silence_libraries(void);

#ifdef __cplusplus
}
#endif
#endif
