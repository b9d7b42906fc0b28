#pragma once

#include <cstdint>
#include <vector>

#include "patches/view.h"

namespace ck::patches {

/// How a reference's pixels and their inverse depths go to a neighbour's patches.
struct Passage : PixelTransfer {
  Passage(const ck_patch_view& reference, const ck_patch_map& neighbor);

  /// Focal length of the neighbour over that of the reference.
  float magnification;
  int width, height;
  const ck_patch* patches;
};

/// When two patches agree.
struct Agreement {
  Agreement(const ck_patch_view& reference, const ck_patch_filter_options& options);

  /// The reference's focal lengths, and its principal point from the centre of pixel (0, 0).
  float fx, fy, cx, cy;
  float cost, reprojection, depth, squared_cosine, contradiction;
};

/// What a neighbour says about a patch.
enum Reply : uint8_t { kNothing = 0, kAgrees = 1, kSeesThrough = 2 };

/// One row of the reference's patches by component; the last vector is filled up with no patches.
struct Row {
  explicit Row(int width);

  void read(const ck_patch* patches, int row, float cost_threshold);

  int y = 0, width;
  std::vector<float> w, gx, gy;
};

/// The replies of one neighbour to a row.
struct Replies {
  explicit Replies(int width);

  std::vector<uint8_t> kind;
  /// The neighbour's cell, where it agrees.
  std::vector<int32_t> cell;
  /// The neighbour's plane over the reference's pixel grid.
  std::vector<float> w, gx, gy;
  /// Between the two patches, in pixels of the coarser view.
  std::vector<float> distance;
};

/// Asks a neighbour about a row of patches. Results differ between instruction sets by rounding.
using Ask = void (*)(const Passage&, const Agreement&, const Row&, Replies&);

Ask ask_function(ck_instructions instructions);

struct AskKernels {
  Ask ask;
};
const AskKernels& portable_ask();
const AskKernels& avx2_ask();
const AskKernels& avx512_ask();

}  // namespace ck::patches
