#pragma once

#include <cstddef>
#include <cstdint>

namespace ck {

/// SplitMix64 (Steele et al., "Fast splittable pseudorandom number generators", OOPSLA 2014): the
/// same sequence on every platform.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint64_t next() { return mixed(state_ += 0x9E3779B97F4A7C15ull); }

  /// A number below `bound`, which must be small compared with 2³².
  size_t below(size_t bound) { return static_cast<size_t>((next() >> 32) * bound >> 32); }

  /// A uniform number in −1…1.
  float symmetric() { return static_cast<float>(next() >> 40) * (2.0f / 16777216.0f) - 1; }

  /// Mixes the bits of a number (hash finalizer): each output bit depends on all input bits, so
  /// consecutive numbers give unrelated results.
  static uint64_t mixed(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }

 private:
  uint64_t state_;
};

}  // namespace ck
