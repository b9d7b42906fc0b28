#include <vector>

#include "core/guard.h"
#include "patches/map.h"

namespace ck::patches {
namespace {

/// Keeps patches that enough other views confirm and that no more views see through.
void filter_by_visibility(uint8_t* accepted, const std::vector<Map>& maps, size_t index,
                          const ck_patch_filter_options& options) {
  const Map& reference = maps[index];
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      uint8_t& keep = accepted[static_cast<size_t>(y) * reference.width + x];
      keep = 0;
      const ck_patch* patch = reference.patch(x, y, options.photometric_threshold);
      if (!patch) continue;
      const Vector3 world = point_of(reference, *patch, x, y);
      const Vector3 normal = reference.normal(*patch, x, y);
      int agreeing = 0, contradicting = 0;
      for (size_t n = 0; n < reference.raw->neighbor_count; ++n) {
        const Map& other = maps[reference.raw->neighbors[n]];
        const auto kind = confirm(reference, other, x, y, world, normal, options).kind;
        agreeing += kind == Confirmation::kAgrees;
        contradicting += kind == Confirmation::kSeesThrough;
      }
      keep = agreeing >= options.minimum_agreeing && contradicting <= agreeing / 2;
    }
  }
}

/// Removes connected patches that are few; neighbours connect where their depths do.
void remove_islands(uint8_t* accepted, const Map& map, int minimum) {
  const int w = map.width, h = map.height;
  std::vector<uint8_t> visited(static_cast<size_t>(w) * h, 0);
  std::vector<int> island;
  for (int start = 0; start < w * h; ++start) {
    if (!accepted[start] || visited[start]) continue;
    island.assign(1, start);
    visited[start] = 1;
    for (size_t next = 0; next < island.size(); ++next) {
      const int cell = island[next], x = cell % w, y = cell / w;
      const float depth = map.raw->patches[cell].inverse_depth;
      const int around[4] = {x > 0 ? cell - 1 : -1, x + 1 < w ? cell + 1 : -1,
                             y > 0 ? cell - w : -1, y + 1 < h ? cell + w : -1};
      for (int other : around) {
        if (other < 0 || visited[other] || !accepted[other]) continue;
        if (std::abs(map.raw->patches[other].inverse_depth / depth - 1) > 0.02f) continue;
        visited[other] = 1;
        island.push_back(other);
      }
    }
    if (static_cast<int>(island.size()) >= minimum) continue;
    for (int cell : island) accepted[cell] = 0;
  }
}

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_filter(uint8_t* accepted, const ck_patch_map* maps, size_t map_count,
                            size_t index, const ck_patch_filter_options* options) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(accepted && maps && options && index < map_count, "missing argument");
    const std::vector<Map> all(maps, maps + map_count);
    filter_by_visibility(accepted, all, index, *options);
    remove_islands(accepted, all[index], options->minimum_island);
  });
}
