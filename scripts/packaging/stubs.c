// What OpenCV's archive refers to and the program never calls: linear algebra, OpenGL and TBB.
//
// Without these, the static executable would carry BLAS, LAPACK, X11 and TBB. OpenCV runs on one
// thread here (see CKernels/core/silence.cpp), which needs TBB's arena only to leave it unused.
#include <stdio.h>
#include <stdlib.h>

#define NEVER_CALLED(name)                                              \
  void name(void) {                                                     \
    fputs("error: " #name " is not part of this program\n", stderr);    \
    abort();                                                            \
  }

NEVER_CALLED(cblas_cgemm)
NEVER_CALLED(cblas_dgemm)
NEVER_CALLED(cblas_sgemm)
NEVER_CALLED(cblas_zgemm)
NEVER_CALLED(dgels_)
NEVER_CALLED(dgeqrf_)
NEVER_CALLED(dgesdd_)
NEVER_CALLED(dgesv_)
NEVER_CALLED(dgetrf_)
NEVER_CALLED(dposv_)
NEVER_CALLED(dpotrf_)
NEVER_CALLED(sgels_)
NEVER_CALLED(sgeqrf_)
NEVER_CALLED(sgesdd_)
NEVER_CALLED(sgesv_)
NEVER_CALLED(sgetrf_)
NEVER_CALLED(sposv_)
NEVER_CALLED(spotrf_)

NEVER_CALLED(glXGetProcAddressARB)

// tbb::detail::r1, mangled.
NEVER_CALLED(_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvmRKNS2_14execution_dataE)
NEVER_CALLED(_ZN3tbb6detail2r110initializeERNS0_2d118task_group_contextE)
NEVER_CALLED(_ZN3tbb6detail2r114execution_slotEPKNS0_2d114execution_dataE)
NEVER_CALLED(_ZN3tbb6detail2r114notify_waitersEm)
NEVER_CALLED(
    _ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_)
NEVER_CALLED(_ZN3tbb6detail2r128is_group_execution_cancelledERNS0_2d118task_group_contextE)
NEVER_CALLED(_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE)
NEVER_CALLED(_ZN3tbb6detail2r17destroyERNS0_2d118task_group_contextE)
NEVER_CALLED(_ZN3tbb6detail2r17executeERNS0_2d115task_arena_baseERNS2_13delegate_baseE)
NEVER_CALLED(_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm)
NEVER_CALLED(_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE)

// cv::setNumThreads calls these three.
void _ZN3tbb6detail2r110initializeERNS0_2d115task_arena_baseE(void *arena) { (void)arena; }
void _ZN3tbb6detail2r19terminateERNS0_2d115task_arena_baseE(void *arena) { (void)arena; }
int _ZN3tbb6detail2r115max_concurrencyEPKNS0_2d115task_arena_baseE(const void *arena) {
  (void)arena;
  return 1;
}
