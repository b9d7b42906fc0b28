#include <algorithm>

#include "core/guard.h"
#include "patches/comparison.h"
#include "patches/expand.h"
#include "patches/smooth.h"

namespace ck::patches {
namespace {

/// Initializes finer patches from filtered coarse ones.
class Parents {
 public:
  explicit Parents(const ck_patch_map& map)
      : map_(map), grid_(map.view.camera.width, map.view.camera.height) {
    grid_.read(map.patches);
    for (const Plane& plane : grid_.planes) range_.include(plane.w);
  }

  /// The finer patches, each with the sources to compare with.
  Grid children(int width, int height) const {
    Grid fine = refine_grid(grid_, width, height);
    for (int y = 0; y < height; y += 2) {
      for (int x = 0; x < width; x += 2) {
        const uint8_t sources =
            sources_at(std::min(x / 2, grid_.width - 1), std::min(y / 2, grid_.height - 1));
        for (int j = y; j < std::min(y + 2, height); ++j) {
          for (int i = x; i < std::min(x + 2, width); ++i) set(fine, fine.index(i, j), sources);
        }
      }
    }
    return fine;
  }

  const InverseDepthRange& range() const { return range_; }

 private:
  /// The neighbors that are consistent with the accepted patches around, because only they see the
  /// surface; all neighbors if there are fewer than three. None if the filter rejected all patches
  /// around and none of them has a low cost: nothing that would pass the filter can grow from
  /// these.
  uint8_t sources_at(int x, int y) const {
    // Chosen: by trial.
    constexpr int kEnough = 3;
    bool is_promising = false;
    unsigned consistent = 0;
    for (int j = std::max(0, y - 1); j <= std::min(grid_.height - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(grid_.width - 1, x + 1); ++i) {
        const size_t cell = grid_.index(i, j);
        if (map_.states[cell]) consistent |= map_.visibility[cell];
        is_promising |= map_.states[cell] != 0 || grid_.costs[cell] < kPromisingCost;
      }
    }
    if (!is_promising) return 0;
    return __builtin_popcount(consistent) < kEnough ? kAllSources
                                                    : static_cast<uint8_t>(consistent);
  }

  static void set(Grid& fine, size_t cell, uint8_t sources) {
    fine.sources[cell] = sources;
    if (sources) return;
    fine.planes[cell] = Plane();
    fine.costs[cell] = kNoPatch;
  }

  const ck_patch_map& map_;
  Grid grid_;
  InverseDepthRange range_;
};

Grid refine(const ck_patch_view& reference, const ck_patch_view* sources, size_t count,
            const ck_patch_map& coarse, const ck_patch_options& options,
            const ck_control* control) {
  const Parents parents(coarse);
  Grid grid = parents.children(reference.camera.width, reference.camera.height);
  if (parents.range().is_empty()) return grid;
  const Pyramids pyramids(reference, sources, count, 1);
  const Comparison comparison =
      pyramids.compare(0, parents.range(), kRefinementRangeMargin, options);
  Sweep sweep;
  sweep.refinement_steps = options.refinement_steps;
  sweep.may_inherit = true;
  expand(grid, comparison, kernels(options.instructions), sweep, control, 0, 1);
  smooth(grid, comparison);
  return grid;
}

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_refine(const ck_patch_view* reference, const ck_patch_view* sources,
                            size_t source_count, const ck_patch_map* coarse,
                            const ck_patch_options* options, const ck_control* control,
                            ck_patch* patches) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(patches && reference && sources && coarse && coarse->states && coarse->visibility &&
                    options,
                "missing argument");
    check_views(*reference, source_count);
    const ck_camera &half = coarse->view.camera, &whole = reference->camera;
    ck::require(half.width == whole.width / 2 && half.height == whole.height / 2,
                "the coarse patches are not of half the resolution");
    refine(*reference, sources, source_count, *coarse, *options, control).write(patches);
  });
}
