#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "ck_core.h"

void ck_release_free_memory(void) {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}
