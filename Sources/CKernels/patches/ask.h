#pragma once

#include <cstdint>
#include <vector>

#include "patches/view.h"

namespace ck::patches {

/// Maps the pixels of a reference view and their inverse depths into the patch map of a neighbor.
struct Passage : PixelTransfer {
  Passage(const ck_patch_view& reference, const ck_patch_map& neighbor);

  /// Ratio of the neighbor's focal length to that of the reference.
  float magnification;
  int width, height;
  const ck_patch* patches;
};

/// Thresholds of geometric consistency, with the reference intrinsics that the test needs.
struct Agreement {
  Agreement(const ck_patch_view& reference, const ck_patch_filter_options& options);

  /// The reference's focal lengths and principal point in pixels, relative to the center of pixel
  /// (0, 0).
  float fx, fy, cx, cy;
  /// Largest matching cost, disparity in pixels, relative depth difference; signed square of the
  /// smallest cosine between normals; relative depth difference of a free-space violation.
  float cost, reprojection, depth, squared_cosine, contradiction;
};

/// Result of testing a patch against a neighbor's patch map: no evidence, geometrically consistent,
/// or the neighbor observes a surface behind the patch (free-space violation).
enum Reply : uint8_t { kNothing = 0, kAgrees = 1, kSeesThrough = 2 };

/// One row of the reference's patches as a structure of arrays, padded to whole vectors with cells
/// without patches.
struct Row {
  explicit Row(int width);

  /// Loads a row; patches with a cost of `cost_threshold` or more are treated as missing.
  void read(const ck_patch* patches, int row, float cost_threshold);

  int y = 0, width;
  std::vector<float> w, gx, gy;
};

/// The results of testing a row of patches against one neighbor.
struct Replies {
  explicit Replies(int width);

  std::vector<uint8_t> kind;
  /// Index of the neighbor's cell; valid where it is consistent.
  std::vector<int32_t> cell;
  /// The neighbor's plane, expressed over the reference's pixel grid.
  std::vector<float> w, gx, gy;
  /// Disparity between the two patches, in pixels of the coarser view.
  std::vector<float> distance;
};

/// Tests a row of patches against one neighbor. Results of different instruction sets differ by
/// rounding.
using Ask = void (*)(const Passage&, const Agreement&, const Row&, Replies&);

/// The implementation for an instruction set.
Ask ask_function(ck_instructions instructions);

struct AskKernels {
  Ask ask;
};
const AskKernels& portable_ask();
const AskKernels& avx2_ask();
const AskKernels& avx512_ask();

}  // namespace ck::patches
