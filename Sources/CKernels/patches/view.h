#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "ck_patches.h"

namespace ck::patches {

/// Largest number of source views of a reference. Limit: the bits of a byte.
constexpr int kMaximumSources = 8;
/// Number of texels of a patch: 4 × 4 pixels of the reference at these offsets. Measured: offsets
/// of 0.6 and 1.8 pixels were tried and not kept (four views of boot, BENCHMARKS.md of `a00f5c5`).
constexpr int kTexels = 16;
constexpr int kTexelOffsets[4] = {-2, -1, 1, 2};
/// Width in pixels of the image border without patches. Limit: the largest offset plus one for
/// gradients.
constexpr int kMargin = 3;

/// The luma of a view at one resolution.
struct Image {
  int width = 0, height = 0;
  std::vector<uint8_t> luma;

  size_t pixel_count() const { return static_cast<size_t>(width) * height; }
};

/// The luma of a view at full resolution.
Image image_of(const ck_patch_view& view);

/// Halves both sides by averaging 2 × 2 pixels.
Image half(const Image& image);

/// Packs each pixel with its right, lower and diagonal neighbors into a word, so that a bilinear
/// sample takes one gather.
void pack(uint32_t* texels, const Image& image);

/// Maps the pixels of one view and their inverse depths w into another, both reduced to `scale` of
/// their size: q = base + x · column0 + y · column1 + w · epipole, (u, v) = q.xy / q.z.
struct PixelTransfer {
  PixelTransfer(const ck_patch_view& from, const ck_patch_view& to, double scale);

  float column0[3], column1[3], base[3], epipole[3];
};

/// The mapping of the reference's pixels into its sources, one lane per source; see
/// `PixelTransfer`.
///
/// Lanes without source are zero and therefore never valid.
struct alignas(32) Warps {
  int count = 0;
  float column0[3][kMaximumSources] = {}, column1[3][kMaximumSources] = {};
  float base[3][kMaximumSources] = {}, epipole[3][kMaximumSources] = {};
  /// Largest pixel coordinates that can be sampled.
  float limit_u[kMaximumSources] = {}, limit_v[kMaximumSources] = {};
  /// Start of a source's packed pixels in `texels`, and its width.
  int offset[kMaximumSources] = {}, stride[kMaximumSources] = {};
  std::vector<uint32_t> texels;
};

/// Appends a source, with both views reduced to `scale` of their size.
void add_source(Warps& warps, const ck_patch_view& reference, const ck_patch_view& source,
                double scale, const Image& image);

}  // namespace ck::patches
