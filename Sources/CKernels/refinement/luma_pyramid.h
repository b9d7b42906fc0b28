#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "refinement/cubic_samples.h"

namespace ck {

/// A luma pyramid, sampled by cubic interpolation.
///
/// Positions are in pixels of the full image, from the corner of its top-left pixel, at every
/// level.
class LumaPyramid {
 public:
  LumaPyramid(const uint8_t* pixels, int width, int height, int channels, size_t stride,
              ck_instructions instructions);

  /// The coarsest level whose pixels are at most `spacing` pixels of the full image wide.
  int level_for(double spacing) const;

  /// Samples a grid of `side` × `side` points, at most `kMaximumSamplesPerSide`, centered at (x,
  /// y); false if it leaves the image. One step along a row of the grid is (ax, ay) pixels, one
  /// along a column (bx, by).
  bool sample_grid(int level, double x, double y, double ax, double ay, double bx, double by,
                   int side, float* values) const;

 private:
  struct Level {
    int width, height;
    std::vector<uint8_t> pixels;
  };

  void add_half();

  CubicSampler sampler_;
  std::vector<Level> levels_;
};

}  // namespace ck
