#include <algorithm>
#include <vector>

#include "core/guard.h"
#include "patches/map.h"

namespace ck::patches {
namespace {

/// Other views that must agree with a patch of this cost.
///
/// Where texture is weak the correlation says little, and one more view must agree instead. Where
/// there are few other views, all but one need not agree.
int required_views(int neighbors, const ck_patch& patch, const ck_patch_filter_options& options) {
  const int regular = std::min(options.minimum_agreeing, std::max(1, neighbors - 1));
  return patch.cost < options.photometric_threshold ? regular : regular + 1;
}

/// Keeps patches that enough other views confirm and that no more views see through.
void filter_by_visibility(uint8_t* states, const Map& reference, const std::vector<Map>& neighbors,
                          const ck_patch_filter_options& options, const ck_control* control) {
  const int count = static_cast<int>(neighbors.size());
  for (int y = 0; y < reference.height; ++y) {
    step(control, static_cast<double>(y) / reference.height);
    for (int x = 0; x < reference.width; ++x) {
      uint8_t& state = states[static_cast<size_t>(y) * reference.width + x];
      state = ck_patch_rejected;
      const ck_patch* patch = reference.patch(x, y, options.weak_texture_threshold);
      if (!patch) continue;
      const Vector3 world = point_of(reference, *patch, x, y);
      const Vector3 normal = reference.normal(*patch, x, y);
      int agreeing = 0, contradicting = 0;
      for (const Map& other : neighbors) {
        const auto kind = confirm(reference, other, x, y, world, normal, options).kind;
        agreeing += kind == Confirmation::kAgrees;
        contradicting += kind == Confirmation::kSeesThrough;
      }
      const bool passes =
          agreeing >= required_views(count, *patch, options) && contradicting <= agreeing / 2;
      if (passes) state = ck_patch_accepted;
    }
  }
}

/// Removes patches at the border of the accepted ones that look like the rejected pixels around
/// them: a plain background beside an outline borrows the outline's depth.
void remove_fringe(uint8_t* states, const Map& map, float contrast) {
  constexpr int kRadius = 3;
  const int w = map.width, h = map.height;
  const uint8_t* luma = map.raw->view.luma;
  const std::vector<uint8_t> before(states, states + static_cast<size_t>(w) * h);
  for (int y = kRadius; y < h - kRadius; ++y) {
    for (int x = kRadius; x < w - kRadius; ++x) {
      const size_t cell = static_cast<size_t>(y) * w + x;
      if (!before[cell]) continue;
      float accepted = 0, rejected = 0;
      for (int dy = -kRadius; dy <= kRadius; ++dy) {
        for (int dx = -kRadius; dx <= kRadius; ++dx) {
          const size_t other = cell + static_cast<ptrdiff_t>(dy) * w + dx;
          const float difference = (luma[other] - luma[cell]) / contrast;
          (before[other] ? accepted : rejected) += 1 / (1 + difference * difference);
        }
      }
      if (rejected > accepted) states[cell] = ck_patch_rejected;
    }
  }
}

/// Removes connected patches that are few; neighbours connect where their depths do.
void remove_islands(uint8_t* states, const Map& map, int minimum) {
  const int w = map.width, h = map.height;
  std::vector<uint8_t> visited(static_cast<size_t>(w) * h, 0);
  std::vector<int> island;
  for (int start = 0; start < w * h; ++start) {
    if (!states[start] || visited[start]) continue;
    island.assign(1, start);
    visited[start] = 1;
    for (size_t next = 0; next < island.size(); ++next) {
      const int cell = island[next], x = cell % w, y = cell / w;
      const float depth = map.raw->patches[cell].inverse_depth;
      const int around[4] = {x > 0 ? cell - 1 : -1, x + 1 < w ? cell + 1 : -1,
                             y > 0 ? cell - w : -1, y + 1 < h ? cell + w : -1};
      for (int other : around) {
        if (other < 0 || visited[other] || !states[other]) continue;
        if (std::abs(map.raw->patches[other].inverse_depth / depth - 1) > 0.02f) continue;
        visited[other] = 1;
        island.push_back(other);
      }
    }
    if (static_cast<int>(island.size()) >= minimum) continue;
    for (int cell : island) states[cell] = 0;
  }
}

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_filter(uint8_t* states, const ck_patch_map* reference,
                            const ck_patch_map* neighbors, size_t neighbor_count,
                            const ck_patch_filter_options* options, const ck_control* control) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(states && reference && options && (neighbors || neighbor_count == 0),
                "missing argument");
    const Map map(*reference);
    const std::vector<Map> others(neighbors, neighbors + neighbor_count);
    filter_by_visibility(states, map, others, *options, control);
    for (int pass = 0; pass < options->fringe_passes; ++pass) {
      remove_fringe(states, map, options->fringe_contrast);
    }
    remove_islands(states, map, options->minimum_island);
  });
}
