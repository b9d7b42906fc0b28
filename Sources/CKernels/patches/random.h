#pragma once

#include <cstdint>

namespace ck::patches {

/// A random sequence that depends on its seeds alone (PCG's output hash over a Weyl sequence).
class Random {
 public:
  Random(uint32_t a, uint32_t b, uint32_t c) : state_(hash(hash(hash(a) ^ b) ^ c)) {}

  /// Uniform in −1…1.
  float symmetric() {
    state_ += 0x9e3779b9u;
    return static_cast<float>(hash(state_) >> 8) * (2.0f / 16777216.0f) - 1;
  }

 private:
  static uint32_t hash(uint32_t v) {
    v = v * 747796405u + 2891336453u;
    v = ((v >> ((v >> 28) + 4)) ^ v) * 277803737u;
    return (v >> 22) ^ v;
  }

  uint32_t state_;
};

}  // namespace ck::patches
