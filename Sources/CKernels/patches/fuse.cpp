#include <algorithm>
#include <vector>

#include "core/guard.h"
#include "patches/map.h"

namespace ck::patches {
namespace {

constexpr size_t kMaxPhotos = sizeof(ck_fused_patch::photos) / sizeof(uint16_t);

/// The patches of several views that show one piece of surface.
struct Group {
  std::vector<Vector3> points;
  Vector3 normal = Vector3::Zero();
  Eigen::Vector3i color = Eigen::Vector3i::Zero();
  float cost = 0;
  std::vector<uint16_t> photos;

  void clear() {
    points.clear();
    photos.clear();
    normal.setZero();
    color.setZero();
    cost = 0;
  }

  void add(const Map& map, size_t index, int x, int y, const Vector3& point) {
    const size_t cell = static_cast<size_t>(y) * map.width + x;
    const ck_patch& patch = map.raw->patches[cell];
    points.push_back(point);
    normal += map.normal(patch, x, y);
    const uint8_t* rgb = map.raw->rgb + 3 * cell;
    color += Eigen::Vector3i(rgb[0], rgb[1], rgb[2]);
    cost += patch.cost;
    if (photos.size() < kMaxPhotos) photos.push_back(static_cast<uint16_t>(index));
  }
};

Vector3 median(std::vector<Vector3>& points) {
  Vector3 result;
  const size_t middle = points.size() / 2;
  for (int axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Vector3& a, const Vector3& b) { return a[axis] < b[axis]; };
    std::nth_element(points.begin(), points.begin() + middle, points.end(), less);
    const float upper = points[middle][axis];
    if (points.size() % 2 == 1) {
      result[axis] = upper;
    } else {
      const auto lower = std::max_element(points.begin(), points.begin() + middle, less);
      result[axis] = 0.5f * (upper + (*lower)[axis]);
    }
  }
  return result;
}

ck_fused_patch fuse(Group& group, const Map& reference) {
  ck_fused_patch result{};
  const auto count = static_cast<int>(group.points.size());
  const Vector3 position = median(group.points), normal = group.normal.normalized();
  for (int i = 0; i < 3; ++i) {
    result.position[i] = position[i];
    result.normal[i] = normal[i];
    result.color[i] = static_cast<uint8_t>((group.color[i] + count / 2) / count);
  }
  result.consistency = 1 - group.cost / static_cast<float>(count);
  result.footprint = reference.to_camera(position).z() / reference.fx;
  std::sort(group.photos.begin(), group.photos.end());
  result.photo_count = static_cast<uint8_t>(group.photos.size());
  std::copy(group.photos.begin(), group.photos.end(), result.photos);
  return result;
}

/// Collects who agrees with a patch; false when an agreeing view holds the surface at less cost.
bool collect(Group& group, const std::vector<Map>& maps, const uint8_t* const* accepted,
             size_t index, int x, int y, const ck_patch_filter_options& options) {
  const Map& reference = maps[index];
  const ck_patch& patch = reference.raw->patches[static_cast<size_t>(y) * reference.width + x];
  const Vector3 world = point_of(reference, patch, x, y);
  const Vector3 normal = reference.normal(patch, x, y);
  group.clear();
  group.add(reference, index, x, y, world);
  for (size_t n = 0; n < reference.raw->neighbor_count; ++n) {
    const auto other = static_cast<size_t>(reference.raw->neighbors[n]);
    const auto found = confirm(reference, maps[other], x, y, world, normal, options);
    if (found.kind != Confirmation::kAgrees) continue;
    const size_t cell = static_cast<size_t>(found.y) * maps[other].width + found.x;
    if (!accepted[other][cell]) continue;
    const float cost = maps[other].raw->patches[cell].cost;
    if (cost < patch.cost || (cost == patch.cost && other < index)) return false;
    if (found.distance <= options.fusion_threshold) {
      group.add(maps[other], other, found.x, found.y, found.point);
    }
  }
  return true;
}

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_fuse(ck_fused_patch* fused, size_t* fused_count, const ck_patch_map* maps,
                          const uint8_t* const* accepted, size_t map_count, size_t index,
                          const ck_patch_filter_options* options) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(fused && fused_count && maps && accepted && options && index < map_count,
                "missing argument");
    const std::vector<Map> all(maps, maps + map_count);
    const Map& reference = all[index];
    Group group;
    *fused_count = 0;
    for (int y = 0; y < reference.height; ++y) {
      for (int x = 0; x < reference.width; ++x) {
        if (!accepted[index][static_cast<size_t>(y) * reference.width + x]) continue;
        if (!collect(group, all, accepted, index, x, y, *options)) continue;
        fused[(*fused_count)++] = fuse(group, reference);
      }
    }
  });
}
