#pragma once

#include <cstddef>
#include <cstdint>

namespace ck {

/// A grid of `side` × `side` positions in an image, in pixels from the center of the first one.
struct SampleGrid {
  const uint8_t* pixels;
  size_t stride;
  int side;
  /// The center.
  double x, y;
  /// One step along a row, and one along a column.
  double ax, ay, bx, by;
};

/// Largest side of a grid. Limit: that of a template.
constexpr int kMaximumSamplesPerSide = 13;

/// Samples an image at a grid by cubic interpolation (Keys, "Cubic convolution interpolation",
/// 1981). Positions are 1 to 2 pixels or more inside the image.
using CubicSampler = void (*)(const SampleGrid& grid, float* values);

void sample_cubic(const SampleGrid& grid, float* values);
/// The same, to the last bit.
void sample_cubic_avx2(const SampleGrid& grid, float* values);

}  // namespace ck
