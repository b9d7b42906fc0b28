#include <algorithm>
#include <vector>

#include "core/parallel.h"
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

  /// Notes a view that sees the surface.
  void see(size_t index) {
    if (photos.size() < kMaxPhotos) photos.push_back(static_cast<uint16_t>(index));
  }

  /// Takes a view's own patch in.
  void add(const Map& map, int x, int y, const Vector3& point) {
    const size_t cell = static_cast<size_t>(y) * map.width + x;
    const ck_patch& patch = map.raw->patches[cell];
    points.push_back(point);
    normal += map.normal(patch, x, y);
    const uint8_t* rgb = map.raw->rgb + 3 * cell;
    color += Eigen::Vector3i(rgb[0], rgb[1], rgb[2]);
    cost += patch.cost;
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

/// Fuses the accepted patches of one view, row by row.
class Fusion {
 public:
  Fusion(const std::vector<Map>& maps, uint8_t* const* states, size_t index,
         const ck_patch_filter_options& options)
      : maps_(maps), states_(states), index_(index), options_(options) {}

  std::vector<ck_fused_patch> row(int y) const {
    const Map& reference = maps_[index_];
    std::vector<ck_fused_patch> fused;
    Group group;
    for (int x = 0; x < reference.width; ++x) {
      if (load(index_, x, y) != ck_patch_accepted) continue;
      collect(group, x, y);
      fused.push_back(fuse(group, reference));
    }
    return fused;
  }

 private:
  uint8_t load(size_t map, int x, int y) const {
    return __atomic_load_n(&states_[map][cell(map, x, y)], __ATOMIC_RELAXED);
  }

  size_t cell(size_t map, int x, int y) const {
    return static_cast<size_t>(y) * maps_[map].width + x;
  }

  /// Collects the accepted patches that agree with one and marks those of later views as fused.
  ///
  /// Rows run at once: marks are only ever set, and never in this view, so order doesn't matter.
  void collect(Group& group, int x, int y) const {
    const Map& reference = maps_[index_];
    const ck_patch& patch = reference.raw->patches[cell(index_, x, y)];
    const Vector3 world = point_of(reference, patch, x, y);
    const Vector3 normal = reference.normal(patch, x, y);
    group.clear();
    group.see(index_);
    group.add(reference, x, y, world);
    for (size_t n = 0; n < reference.raw->neighbor_count; ++n) {
      const auto other = static_cast<size_t>(reference.raw->neighbors[n]);
      const auto found = confirm(reference, maps_[other], x, y, world, normal, options_);
      if (found.kind != Confirmation::kAgrees) continue;
      group.see(other);
      if (!load(other, found.x, found.y) || found.distance > options_.fusion_threshold) continue;
      group.add(maps_[other], found.x, found.y, found.point);
      if (other > index_) {
        __atomic_store_n(&states_[other][cell(other, found.x, found.y)],
                         static_cast<uint8_t>(ck_patch_fused), __ATOMIC_RELAXED);
      }
    }
  }

  const std::vector<Map>& maps_;
  uint8_t* const* states_;
  size_t index_;
  const ck_patch_filter_options& options_;
};

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_fuse(ck_fused_patch* fused, size_t* fused_count, const ck_patch_map* maps,
                          uint8_t* const* states, size_t map_count, size_t index,
                          const ck_patch_filter_options* options, const ck_control* control) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(fused && fused_count && maps && states && options && index < map_count,
                "missing argument");
    const std::vector<Map> all(maps, maps + map_count);
    const Fusion fusion(all, states, index, *options);
    std::vector<std::vector<ck_fused_patch>> rows(static_cast<size_t>(all[index].height));
    ck::parallel_for(control, rows.size(),
                     [&](size_t y) { rows[y] = fusion.row(static_cast<int>(y)); });
    *fused_count = 0;
    for (const auto& row : rows) {
      fused = std::copy(row.begin(), row.end(), fused);
      *fused_count += row.size();
    }
  });
}
