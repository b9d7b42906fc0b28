#pragma once

#include <cstddef>
#include <cstdint>

namespace ck {

/// Halves a `width × height` gray image without padding by averaging 2 × 2 pixels; `result` holds
/// `(width / 2) × (height / 2)` bytes.
inline void halve(const uint8_t* pixels, int width, int height, uint8_t* result) {
  for (int y = 0; y < height / 2; ++y) {
    const uint8_t* upper = pixels + static_cast<ptrdiff_t>(2 * y) * width;
    const uint8_t* lower = upper + width;
    uint8_t* out = result + static_cast<ptrdiff_t>(y) * (width / 2);
    for (int x = 0; x < width / 2; ++x) {
      const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
      out[x] = static_cast<uint8_t>((sum + 2) / 4);
    }
  }
}

}  // namespace ck
