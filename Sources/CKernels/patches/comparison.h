#pragma once

#include <algorithm>
#include <cmath>

#include "patches/grid.h"

namespace ck::patches {

/// The inverse depths that some patches have.
struct DepthRange {
  float lowest = 0, highest = 0;

  void include(float w) {
    if (!(w > 0) || !std::isfinite(w)) return;
    lowest = highest > 0 ? std::min(lowest, w) : w;
    highest = std::max(highest, w);
  }

  bool is_empty() const { return !(highest > 0); }
};

/// The photos of a reference and its sources at all resolutions, the finest first.
class Pyramids {
 public:
  Pyramids(const ck_patch_view& reference, const ck_patch_view* sources, size_t count, int levels);

  /// All that scoring the reference's patches takes at one level, for inverse depths up to `margin`
  /// times beyond the range. Valid as long as the pyramids.
  Comparison compare(int level, const DepthRange& range, float margin,
                     const ck_patch_options& options) const;

 private:
  const ck_patch_view& reference_;
  const ck_patch_view* sources_;
  /// Of the reference, then of the sources.
  std::vector<std::vector<Image>> images_;
};

/// Throws where patches can't be made of such a view or with so many sources.
void check_views(const ck_patch_view& reference, size_t source_count);

}  // namespace ck::patches
