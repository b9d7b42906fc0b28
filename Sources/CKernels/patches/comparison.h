#pragma once

#include <algorithm>
#include <cmath>

#include "patches/grid.h"

namespace ck::patches {

/// The range of inverse depths of a set of patches.
struct InverseDepthRange {
  float lowest = 0, highest = 0;

  void include(float w) {
    if (!(w > 0) || !std::isfinite(w)) return;
    lowest = highest > 0 ? std::min(lowest, w) : w;
    highest = std::max(highest, w);
  }

  bool is_empty() const { return !(highest > 0); }
};

/// Image pyramids of a reference and its sources, the full resolution first.
class Pyramids {
 public:
  Pyramids(const ck_patch_view& reference, const ck_patch_view* sources, size_t count, int levels);

  /// The input for scoring the reference's patches at one level, for inverse depths from the lower
  /// end of the range divided by `margin` to its upper end times `margin`. Valid as long as the
  /// pyramids exist.
  Comparison compare(int level, const InverseDepthRange& range, float margin,
                     const ck_patch_options& options) const;

 private:
  const ck_patch_view& reference_;
  const ck_patch_view* sources_;
  /// By view and level: the reference, then the sources.
  std::vector<std::vector<Image>> images_;
};

/// Throws if patches cannot be reconstructed from a view of this size or with this number of
/// sources.
void check_views(const ck_patch_view& reference, size_t source_count);

}  // namespace ck::patches
