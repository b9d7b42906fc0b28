#pragma once

#include <cstdint>
#include <vector>

#include "patches/view.h"

namespace ck::patches {

/// Maps the pixels of a reference view and their inverse depths into the patch map of a neighbor.
struct RelativeProjection : PixelTransfer {
  RelativeProjection(const ck_patch_view& reference, const ck_patch_map& neighbor);

  /// Ratio of the neighbor's focal length to that of the reference.
  float magnification;
  int width, height;
  const ck_patch* patches;
};

/// Thresholds of geometric consistency, with the reference intrinsics that the test needs.
struct ConsistencyThresholds {
  ConsistencyThresholds(const ck_patch_view& reference, const ck_patch_filter_options& options);

  /// The reference's focal lengths and principal point in pixels, relative to the center of pixel
  /// (0, 0).
  float fx, fy, cx, cy;
  /// Largest matching cost, disparity in pixels, relative depth difference; signed square of the
  /// smallest cosine between normals; relative depth difference of a free-space violation.
  float cost, reprojection, depth, squared_cosine, free_space;
};

/// Result of testing a patch against a neighbor's patch map: no evidence, geometrically consistent,
/// or the neighbor observes a surface behind the patch (free-space violation).
enum Consistency : uint8_t { kUnknown = 0, kConsistent = 1, kFreeSpaceViolation = 2 };

/// One row of the reference's patches as a structure of arrays, padded to whole vectors with cells
/// without patches.
struct PatchRow {
  explicit PatchRow(int width);

  /// Loads a row; patches with a cost of `cost_threshold` or more are treated as missing.
  void read(const ck_patch* patches, int row, float cost_threshold);

  int y = 0, width;
  std::vector<float> w, gx, gy;
};

/// The results of testing a row of patches against one neighbor.
struct ConsistencyRow {
  explicit ConsistencyRow(int width);

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
using ConsistencyCheck = void (*)(const RelativeProjection&, const ConsistencyThresholds&,
                                  const PatchRow&, ConsistencyRow&);

/// The implementation for an instruction set.
ConsistencyCheck consistency_check(ck_instructions instructions);

struct ConsistencyKernels {
  ConsistencyCheck geometric_consistency;
};
const ConsistencyKernels& portable_consistency();
const ConsistencyKernels& avx2_consistency();
const ConsistencyKernels& avx512_consistency();

}  // namespace ck::patches
