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

/// Whether `std::cerr` has a stream buffer and glog and OpenCV log at their default levels: false
/// after `ck_silence_libraries`.
bool ck_test_is_logging(void);

#ifdef __cplusplus
}
#endif
#endif
