#include <algorithm>
#include <cmath>
#include <utility>
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

  /// Notes a view that sees the surface.
  void see(const Map& map) {
    if (photos.size() < kMaxPhotos) photos.push_back(static_cast<uint16_t>(map.raw->photo));
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

/// Orders views of one piece of surface: the finest first, the lowest photo among about equals.
///
/// A property of the patch alone, so that any two views order theirs alike.
std::pair<int, int> rank(const Map& map, const ck_patch& patch, int x, int y) {
  const Vector3 ray = map.ray(x + 0.5f, y + 0.5f);
  const Vector3 away = map.rotation * map.normal(patch, x, y);
  const float cosine = std::max(0.1f, -away.dot(ray) / ray.norm());
  const float side = 1 / (patch.inverse_depth * map.fx * std::sqrt(cosine));
  constexpr float kStepsAnOctave = 4;
  return {static_cast<int>(std::floor(std::log2(side) * kStepsAnOctave)), map.raw->photo};
}

/// Fuses the accepted patches of one view.
class Fusion {
 public:
  Fusion(const Map& reference, const std::vector<Map>& neighbors,
         const ck_patch_filter_options& options)
      : reference_(reference), neighbors_(neighbors), options_(options) {}

  ck_fused_patch* run(ck_fused_patch* fused, const ck_control* control) const {
    Group group;
    for (int y = 0; y < reference_.height; ++y) {
      step(control, static_cast<double>(y) / reference_.height);
      for (int x = 0; x < reference_.width; ++x) {
        if (reference_.is_accepted(x, y) && collect(group, x, y))
          *fused++ = fuse(group, reference_);
      }
    }
    return fused;
  }

 private:
  /// Collects the accepted patches that agree with one; false where the point is another view's.
  bool collect(Group& group, int x, int y) const {
    const ck_patch& patch = reference_.at(x, y);
    const Vector3 world = point_of(reference_, patch, x, y);
    const Vector3 normal = reference_.normal(patch, x, y);
    const auto own = rank(reference_, patch, x, y);
    group.clear();
    group.see(reference_);
    group.add(reference_, x, y, world);
    for (const Map& other : neighbors_) {
      const auto found = confirm(reference_, other, x, y, world, normal, options_);
      if (found.kind != Confirmation::kAgrees) continue;
      group.see(other);
      if (!other.is_accepted(found.x, found.y) || found.distance > options_.fusion_threshold) {
        continue;
      }
      if (rank(other, other.at(found.x, found.y), found.x, found.y) < own) return false;
      group.add(other, found.x, found.y, found.point);
    }
    return true;
  }

  const Map& reference_;
  const std::vector<Map>& neighbors_;
  const ck_patch_filter_options& options_;
};

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_fuse(ck_fused_patch* fused, size_t* fused_count, const ck_patch_map* reference,
                          const ck_patch_map* neighbors, size_t neighbor_count,
                          const ck_patch_filter_options* options, const ck_control* control) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(fused && fused_count && reference && reference->states && options &&
                    (neighbors || neighbor_count == 0),
                "missing argument");
    const Map map(*reference);
    const std::vector<Map> others(neighbors, neighbors + neighbor_count);
    *fused_count = static_cast<size_t>(Fusion(map, others, *options).run(fused, control) - fused);
  });
}
