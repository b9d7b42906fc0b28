#ifndef CK_TESTING_H
#define CK_TESTING_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

// Entry points for tests of the code that kernels share. Not for any other use.

/// Runs the loop over 0..<`count` that all kernels share, on a simulated system that refuses to
/// create more than `available_threads` threads.
///
/// `visits` holds `count` elements; element i is incremented when the loop's body runs for i. The
/// body of element `failing` throws; `SIZE_MAX` for none. `created_threads` receives the number of
/// threads that were created.
ck_status ck_test_parallel_for(size_t count, size_t available_threads, size_t failing,
                               const ck_control* control, int32_t* visits, size_t* created_threads);

/// Runs a kernel that fails with an exception while the process can't allocate memory.
///
/// `message` is that of the exception. Takes all of the process's free memory meanwhile and limits
/// its address space for good: to be called in a process of its own.
ck_status ck_test_failure_without_memory(const char* message);

/// Whether `std::cerr` has a stream buffer and OpenCV logs at its default level: false
/// after `ck_silence_libraries`.
bool ck_test_is_logging(void);

#ifdef __cplusplus
}
#endif
#endif
