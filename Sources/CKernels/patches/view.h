#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "ck_patches.h"

namespace ck::patches {

/// Views that a reference is compared with at most.
constexpr int kMaxSources = 8;
/// Texels of a patch: 4 × 4 pixels of the reference at these offsets.
constexpr int kTexels = 16;
constexpr int kTexelOffsets[4] = {-2, -1, 1, 2};
/// Pixels at the border that have no patch: the largest offset plus one for gradients.
constexpr int kMargin = 3;

/// One resolution of a view's photo.
struct Image {
  int width = 0, height = 0;
  std::vector<uint8_t> luma;

  size_t pixel_count() const { return static_cast<size_t>(width) * height; }
};

/// The view's photo as it is.
Image image_of(const ck_patch_view& view);

/// Halves both sides by averaging 2 × 2 pixels.
Image half(const Image& image);

/// Writes a word for each pixel: itself, its right, lower and diagonal neighbour, so that a
/// bilinear sample is one gather.
void pack(uint32_t* texels, const Image& image);

/// Where the pixels of one view and their inverse depths w go in another, both reduced to `scale`
/// of their size: q = base + x · column0 + y · column1 + w · epipole, (u, v) = q.xy / q.z.
struct PixelTransfer {
  PixelTransfer(const ck_patch_view& from, const ck_patch_view& to, double scale);

  float column0[3], column1[3], base[3], epipole[3];
};

/// Where the reference's pixels go in its sources, a lane a source; see `PixelTransfer`.
///
/// Lanes without source are zero, which no pixel projects to.
struct alignas(32) Warps {
  int count = 0;
  float column0[3][kMaxSources] = {}, column1[3][kMaxSources] = {};
  float base[3][kMaxSources] = {}, epipole[3][kMaxSources] = {};
  /// Largest coordinates that can be sampled.
  float limit_u[kMaxSources] = {}, limit_v[kMaxSources] = {};
  /// Where a source's packed pixels begin in `texels`, and its width.
  int offset[kMaxSources] = {}, stride[kMaxSources] = {};
  std::vector<uint32_t> texels;
};

/// Appends a source to the reference's, both reduced to `scale` of their size.
void add_source(Warps& warps, const ck_patch_view& reference, const ck_patch_view& source,
                double scale, const Image& image);

}  // namespace ck::patches
