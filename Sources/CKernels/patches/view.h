#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "ck_patches.h"

namespace ck::patches {

/// Views that a reference is compared with at most.
constexpr int kMaxSources = 8;
/// Texels of a patch: 4 × 4 at offsets −2, −1, 1, 2 pixels of the reference.
constexpr int kTexels = 16;
/// Pixels at the border that have no patch: the largest offset plus one for gradients.
constexpr int kMargin = 3;

/// One resolution of a view's photo.
struct Image {
  int width = 0, height = 0;
  std::vector<uint8_t> luma;
  /// A pixel, its right, lower and diagonal neighbour in one word, so that a bilinear sample is one
  /// gather.
  std::vector<uint32_t> packed;
};

/// Halves both sides by averaging 2 × 2 pixels.
Image half(const Image& image);

/// Fills `packed`.
void pack(Image& image);

/// Where the reference's pixels go in a source:
/// q = base + x · column0 + y · column1 + inverse depth · epipole, u = q.xy / q.z.
struct Warp {
  float column0[3], column1[3], base[3], epipole[3];
  int width, height;
  const uint32_t* packed;
};

/// A source against the reference, both reduced to `scale` of their size.
Warp make_warp(const ck_patch_view& reference, const ck_patch_view& source, double scale,
               const Image& image);

}  // namespace ck::patches
