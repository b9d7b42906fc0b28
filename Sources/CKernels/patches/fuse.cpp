#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/guard.h"
#include "geometry/pose.h"
#include "patches/constants.h"
#include "patches/geometric_consistency.h"

namespace ck::patches {
namespace {

constexpr size_t kMaximumPhotos = sizeof(ck_fused_patch::photos) / sizeof(uint16_t);

/// A view's estimate of the surface behind a pixel of the reference.
struct Estimate {
  /// Inverse depth on the pixel's viewing ray.
  float w = 0;
  /// In the reference's camera frame, pointing away from the camera.
  float normal[3] = {};
  float weight = 0;
};

/// Estimates of several views for the surface behind one pixel, weighted by how well their photos
/// correlate.
struct Group {
  Estimate sum;
  int count = 0;
  int color[3] = {};
  float cost = 0;
  /// Indices of the consistent neighbors.
  std::vector<size_t> neighbors;

  void clear() {
    sum = Estimate();
    count = 0;
    std::fill(color, color + 3, 0);
    cost = 0;
    neighbors.clear();
  }

  /// Adds the patch of a view.
  void add(const ck_patch_map& map, size_t cell, const Estimate& estimate) {
    const float c = map.patches[cell].cost;
    const float weight = 1 / (kFusionCostOffset + c);
    sum.w += weight * estimate.w;
    for (int i = 0; i < 3; ++i) sum.normal[i] += weight * estimate.normal[i];
    sum.weight += weight;
    for (int i = 0; map.rgb && i < 3; ++i) color[i] += map.rgb[3 * cell + i];
    cost += c;
    ++count;
  }
};

/// `cameraFromWorld` with a row-major rotation.
struct Frame {
  std::array<double, 9> rotation;
  double translation[3];

  explicit Frame(const ck_pose& pose)
      : rotation(rotation_rows(pose)), translation{pose.tx, pose.ty, pose.tz} {}
};

/// Fuses the accepted patches of one view.
class Fusion {
 public:
  Fusion(const ck_patch_map& reference, const ck_patch_map* neighbors, size_t count,
         const ck_patch_filter_options& options)
      : reference_(reference),
        frame_(reference.view.camera_from_world),
        options_(options),
        thresholds_(reference.view, options),
        check_(consistency_check(options.instructions)),
        row_(reference.view.camera.width) {
    for (size_t i = 0; i < count; ++i) neighbors_.push_back(&neighbors[i]);
    // Sorted by photo, so that the result does not depend on the order of the input.
    std::sort(neighbors_.begin(), neighbors_.end(),
              [](const auto* a, const auto* b) { return a->photo < b->photo; });
    for (const ck_patch_map* map : neighbors_) {
      neighbor_frames_.emplace_back(map->view.camera_from_world);
      projections_.emplace_back(reference.view, *map);
      results_.emplace_back(reference.view.camera.width);
    }
  }

  /// Writes at most `capacity` points; returns their number.
  size_t run(ck_fused_patch* fused, size_t capacity, const ck_control* control) {
    size_t count = 0;
    const int width = reference_.view.camera.width, height = reference_.view.camera.height;
    for (int y = 0; y < height; ++y) {
      step(control, static_cast<double>(y) / height);
      const size_t start = static_cast<size_t>(y) * width;
      const uint8_t* states = reference_.states + start;
      row_.read(reference_.patches, y, options_.weak_texture_threshold);
      for (int x = 0; x < width; ++x) row_.w[x] = states[x] ? row_.w[x] : 0;
      for (size_t i = 0; i < projections_.size(); ++i) {
        check_(projections_[i], thresholds_, row_, results_[i]);
      }
      for (int x = 0; x < width; ++x) {
        ck_fused_patch point;
        if (!states[x] || !collect(x, y) || !fuse(point, x, y)) continue;
        require(count < capacity, "there is no room for all points");
        fused[count++] = point;
      }
    }
    return count;
  }

 private:
  /// Converts a plane at a pixel to an estimate of weight 1 with a unit normal.
  Estimate estimate(int x, int y, float w, float gx, float gy) const {
    const float nx = gx * thresholds_.fx, ny = gy * thresholds_.fy;
    const float nz = w + gx * (thresholds_.cx - static_cast<float>(x)) +
                     gy * (thresholds_.cy - static_cast<float>(y));
    const float scale = 1 / std::sqrt(nx * nx + ny * ny + nz * nz);
    return {w, {nx * scale, ny * scale, nz * scale}, 1};
  }

  /// Collects the accepted patches that are consistent with one of the reference; false if the
  /// point belongs to another view (smaller footprint, or equal footprint and lower photo).
  bool collect(int x, int y) {
    const size_t cell = static_cast<size_t>(y) * reference_.view.camera.width + x;
    group_.clear();
    group_.add(reference_, cell, estimate(x, y, row_.w[x], row_.gx[x], row_.gy[x]));
    const int reference_footprint = reference_.states[cell];
    for (size_t i = 0; i < neighbors_.size(); ++i) {
      const ConsistencyRow& r = results_[i];
      if (r.kind[x] != kConsistent) continue;
      const ck_patch_map& other = *neighbors_[i];
      group_.neighbors.push_back(i);
      const auto there = static_cast<size_t>(r.cell[x]);
      const int footprint = other.states ? other.states[there] : 0;
      if (footprint == 0 || r.distance[x] > options_.fusion_threshold) continue;
      if (footprint < reference_footprint ||
          (footprint == reference_footprint && other.photo < reference_.photo))
        return false;
      group_.add(other, there, estimate(x, y, r.w[x], r.gx[x], r.gy[x]));
    }
    return true;
  }

  /// Computes the fused patch; false if no neighbor sees it from the front.
  bool fuse(ck_fused_patch& result, int x, int y) const {
    result = {};
    const Estimate& sum = group_.sum;
    const double depth = sum.weight / sum.w;
    const ck_camera& camera = reference_.view.camera;
    const double* t = frame_.translation;
    const double p[3] = {(x + 0.5 - camera.cx) / camera.fx * depth - t[0],
                         (y + 0.5 - camera.cy) / camera.fy * depth - t[1], depth - t[2]};
    const double n[3] = {-sum.normal[0], -sum.normal[1], -sum.normal[2]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const auto& r = frame_.rotation;
    const int count = group_.count;
    for (int i = 0; i < 3; ++i) {
      result.position[i] = static_cast<float>(r[i] * p[0] + r[3 + i] * p[1] + r[6 + i] * p[2]);
      result.normal[i] =
          static_cast<float>((r[i] * n[0] + r[3 + i] * n[1] + r[6 + i] * n[2]) / length);
      result.color[i] = static_cast<uint8_t>((group_.color[i] + count / 2) / count);
    }
    result.consistency = 1 - group_.cost / static_cast<float>(count);
    result.footprint = static_cast<float>(depth / camera.fx);
    list_photos(result);
    return result.photo_count > 1;
  }

  /// Lists the reference and the consistent neighbors that see the plane from the front.
  void list_photos(ck_fused_patch& result) const {
    const auto add = [&](int photo) {
      if (result.photo_count < kMaximumPhotos) {
        result.photos[result.photo_count++] = static_cast<uint16_t>(photo);
      }
    };
    bool is_listed = false;
    for (size_t i : group_.neighbors) {
      if (!is_in_front(neighbor_frames_[i], result)) continue;
      if (!is_listed && neighbors_[i]->photo > reference_.photo) {
        add(reference_.photo);
        is_listed = true;
      }
      add(neighbors_[i]->photo);
    }
    if (!is_listed) add(reference_.photo);
  }

  static bool is_in_front(const Frame& view, const ck_fused_patch& patch) {
    const float *n = patch.normal, *p = patch.position;
    double dot = 0;
    for (int i = 0; i < 3; ++i) {
      const double* r = view.rotation.data() + 3 * i;
      const double seen = r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + view.translation[i];
      dot += (r[0] * n[0] + r[1] * n[1] + r[2] * n[2]) * seen;
    }
    return dot < 0;
  }

  const ck_patch_map& reference_;
  const Frame frame_;
  const ck_patch_filter_options& options_;
  const ConsistencyThresholds thresholds_;
  const ConsistencyCheck check_;
  std::vector<const ck_patch_map*> neighbors_;
  std::vector<Frame> neighbor_frames_;
  std::vector<RelativeProjection> projections_;
  PatchRow row_;
  std::vector<ConsistencyRow> results_;
  Group group_;
};

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_fuse(const ck_patch_map* reference, const ck_patch_map* neighbors,
                          size_t neighbor_count, const ck_patch_filter_options* options,
                          const ck_control* control, ck_fused_patch* fused, size_t capacity,
                          size_t* fused_count) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(fused && fused_count && reference && reference->states && options &&
                    (neighbors || neighbor_count == 0),
                "missing argument");
    Fusion fusion(*reference, neighbors, neighbor_count, *options);
    *fused_count = fusion.run(fused, capacity, control);
  });
}
