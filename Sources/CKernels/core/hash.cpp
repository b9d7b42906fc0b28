#include <xxhash.h>

#include "ck_core.h"

uint64_t ck_hash(const void* bytes, size_t count, uint64_t seed) {
  return XXH64(bytes, count, seed);
}
