#pragma once

#include <cstddef>
#include <cstdint>

#include "ck_refinement.h"

namespace ck {

/// A grid of positions in an image, in pixels from the center of its first pixel.
struct SampleGrid {
  const uint8_t* pixels;
  size_t stride;
  /// Positions per row and column, at most `CK_TEMPLATE_SIDE`.
  int side;
  /// The center.
  double x, y;
  /// One step along a row, and one along a column.
  double ax, ay, bx, by;
};

/// Samples an image at a grid by cubic interpolation (Keys, "Cubic convolution interpolation",
/// 1981). Positions are 1 to 2 pixels or more inside the image.
using CubicSampler = void (*)(const SampleGrid& grid, float* values);

void sample_cubic(const SampleGrid& grid, float* values);
/// The same, to the last bit.
void sample_cubic_avx2(const SampleGrid& grid, float* values);

}  // namespace ck
