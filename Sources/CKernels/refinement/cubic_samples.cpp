#include "refinement/cubic_samples.h"

#include <cstring>

namespace ck {
namespace {

using Float4 = float __attribute__((vector_size(16)));
using Byte4 = uint8_t __attribute__((vector_size(4)));

inline Float4 load(const uint8_t* pixels) {
  Byte4 bytes;
  std::memcpy(&bytes, pixels, sizeof bytes);
  return __builtin_convertvector(bytes, Float4);
}

/// Weights of four adjacent pixels.
inline Float4 cubic_weights(float t) {
  return Float4{((-0.5f * t + 1) * t - 0.5f) * t, (1.5f * t - 2.5f) * t * t + 1,
                ((-1.5f * t + 2) * t + 0.5f) * t, (0.5f * t - 0.5f) * t * t};
}

}  // namespace

void sample_cubic(const SampleGrid& grid, float* values) {
  const size_t stride = grid.stride;
  const double half = (grid.side - 1) / 2.0;
  for (int j = 0; j < grid.side; ++j) {
    for (int i = 0; i < grid.side; ++i) {
      const float x = static_cast<float>(grid.x + (i - half) * grid.ax + (j - half) * grid.bx);
      const float y = static_cast<float>(grid.y + (i - half) * grid.ay + (j - half) * grid.by);
      const int column = static_cast<int>(x), row = static_cast<int>(y);
      const uint8_t* p = grid.pixels + static_cast<size_t>(row - 1) * stride + column - 1;
      const Float4 wx = cubic_weights(x - static_cast<float>(column));
      const Float4 wy = cubic_weights(y - static_cast<float>(row));
      const Float4 sum = (load(p) * wy[0] + load(p + stride) * wy[1] +
                          load(p + 2 * stride) * wy[2] + load(p + 3 * stride) * wy[3]) *
                         wx;
      *values++ = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
  }
}

}  // namespace ck
