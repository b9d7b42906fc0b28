#include <algorithm>
#include <cmath>
#include <vector>

#include "core/guard.h"
#include "patches/constants.h"
#include "patches/geometric_consistency.h"

namespace ck::patches {
namespace {

/// Views that must be consistent in addition where texture is weak, because the correlation is less
/// reliable there. Measured: without them more of the low-texture set is found, but 0.897 instead
/// of 0.921 of the points are within 0.5 mm; accuracy was preferred (BENCHMARKS.md of `a8536fb`).
constexpr int kAdditionalViews = 1;

/// Consistent views per view that reports a free-space violation. Chosen: by trial.
constexpr int kConsistentPerViolation = 2;

/// Number of other views that must be consistent with a patch of this cost. With few other views,
/// all but one suffice.
int required_views(int neighbors, const ck_patch& patch, const ck_patch_filter_options& options) {
  const int regular = std::min(options.minimum_consistent_views, std::max(1, neighbors - 1));
  return patch.cost < options.photometric_threshold ? regular : regular + kAdditionalViews;
}

/// The logarithm of a patch's side length in steps of a quarter octave, 1…255.
///
/// Depends on the patch alone, so that any two views rank their patches consistently.
uint8_t footprint_class(const ck_patch_view& view, const ck_patch& p, int x, int y) {
  const auto fx = static_cast<float>(view.camera.fx), fy = static_cast<float>(view.camera.fy);
  const float dx = x + 0.5f - static_cast<float>(view.camera.cx),
              dy = y + 0.5f - static_cast<float>(view.camera.cy);
  const float nx = p.gradient_x * fx, ny = p.gradient_y * fy;
  const float nz = p.inverse_depth - p.gradient_x * dx - p.gradient_y * dy;
  const float normal = nx * nx + ny * ny + nz * nz;
  const float ray = dx * dx / (fx * fx) + dy * dy / (fy * fy) + 1;
  const float cosine = std::max(kMinimumFootprintCosine, p.inverse_depth / std::sqrt(normal * ray));
  // The side is 1 / (w · fx · sqrt(cosine)); four steps per octave, centered on 128.
  const float steps = -4 * std::log2(p.inverse_depth * fx) - 2 * std::log2(cosine);
  return static_cast<uint8_t>(std::clamp(std::floor(steps) + 128, 1.0f, 255.0f));
}

/// Accumulates the results of one neighbor. Separate arrays let the compiler vectorize the loop.
void count(const uint8_t* __restrict kinds, size_t n, uint8_t bit, uint8_t* __restrict consistent,
           uint8_t* __restrict violating, uint8_t* __restrict visibility) {
  for (size_t x = 0; x < n; ++x) {
    const uint8_t is_consistent = kinds[x] & kConsistent;
    consistent[x] = static_cast<uint8_t>(consistent[x] + is_consistent);
    visibility[x] |= is_consistent ? bit : uint8_t{0};
    violating[x] = static_cast<uint8_t>(violating[x] + kinds[x] / kFreeSpaceViolation);
  }
}

/// Accepts patches that enough other views are consistent with, unless more than half as many
/// report a free-space violation.
class VisibilityFilter {
 public:
  VisibilityFilter(const ck_patch_map& reference, const ck_patch_map* neighbors, size_t count,
                   const ck_patch_filter_options& options)
      : reference_(reference),
        options_(options),
        thresholds_(reference.view, options),
        check_(consistency_check(options.instructions)),
        row_(reference.view.camera.width),
        results_(reference.view.camera.width),
        consistent_(row_.w.size()),
        violating_(row_.w.size()),
        visibility_(row_.w.size()) {
    for (size_t i = 0; i < count; ++i) projections_.emplace_back(reference.view, neighbors[i]);
  }

  void run(uint8_t* states, uint8_t* visibility, const ck_control* control) {
    const int width = reference_.view.camera.width, height = reference_.view.camera.height;
    for (int y = 0; y < height; ++y) {
      step(control, static_cast<double>(y) / height);
      row_.read(reference_.patches, y, options_.weak_texture_threshold);
      check_neighbors();
      const size_t start = static_cast<size_t>(y) * width;
      for (int x = 0; x < width; ++x) {
        const ck_patch& patch = reference_.patches[start + x];
        states[start + x] = passes(patch, x) ? footprint_class(reference_.view, patch, x, y) : 0;
      }
      if (visibility) std::copy_n(visibility_.begin(), width, visibility + start);
    }
  }

 private:
  void check_neighbors() {
    std::fill(consistent_.begin(), consistent_.end(), 0);
    std::fill(violating_.begin(), violating_.end(), 0);
    std::fill(visibility_.begin(), visibility_.end(), 0);
    uint8_t bit = 1;
    for (const RelativeProjection& projection : projections_) {
      check_(projection, thresholds_, row_, results_);
      count(results_.kind.data(), consistent_.size(), bit, consistent_.data(), violating_.data(),
            visibility_.data());
      bit = static_cast<uint8_t>(bit << 1);
    }
  }

  bool passes(const ck_patch& patch, int x) const {
    return row_.w[x] > 0 && violating_[x] <= consistent_[x] / kConsistentPerViolation &&
           consistent_[x] >= required_views(static_cast<int>(projections_.size()), patch, options_);
  }

  const ck_patch_map& reference_;
  const ck_patch_filter_options& options_;
  const ConsistencyThresholds thresholds_;
  const ConsistencyCheck check_;
  std::vector<RelativeProjection> projections_;
  PatchRow row_;
  ConsistencyRow results_;
  std::vector<uint8_t> consistent_, violating_, visibility_;
};

/// Removes accepted boundary patches that resemble the rejected pixels around them: foreground
/// fattening, where a textureless background next to an outline gets the outline's depth.
class DepthEdgeFilter {
 public:
  explicit DepthEdgeFilter(float contrast) {
    for (int difference = 0; difference < 256; ++difference) {
      const float ratio = static_cast<float>(difference) / contrast;
      similarity_[difference] = static_cast<int32_t>(std::lround(65536 / (1 + ratio * ratio)));
    }
  }

  void remove(uint8_t* states, const ck_patch_view& view) const {
    const int w = view.camera.width, h = view.camera.height;
    const std::vector<uint8_t> before(states, states + static_cast<size_t>(w) * h);
    std::vector<int32_t> rejected(static_cast<size_t>(w));
    for (int y = kRadius; y < h - kRadius; ++y) {
      count_rejected(rejected, &before[static_cast<size_t>(y) * w], w);
      for (int x = kRadius; x < w - kRadius; ++x) {
        const size_t cell = static_cast<size_t>(y) * w + x;
        if (!before[cell]) continue;
        int around = 0;
        for (int dx = -kRadius; dx <= kRadius; ++dx) around += rejected[x + dx];
        if (around > 0 && is_fattened(before, view, cell)) states[cell] = 0;
      }
    }
  }

 private:
  /// Radius of the square window in pixels. Chosen: by trial.
  static constexpr int kRadius = 3;

  /// Number of rejected pixels per column within the radius of a row.
  static void count_rejected(std::vector<int32_t>& result, const uint8_t* row, int width) {
    std::fill(result.begin(), result.end(), 0);
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      const uint8_t* states = row + static_cast<ptrdiff_t>(dy) * width;
      for (int x = 0; x < width; ++x) result[x] += states[x] == 0;
    }
  }

  /// Whether the pixel is more similar to the rejected pixels around it than to the accepted ones.
  bool is_fattened(const std::vector<uint8_t>& states, const ck_patch_view& view,
                   size_t cell) const {
    const int luma = view.luma[cell];
    int32_t balance = 0;
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      const size_t row = cell + static_cast<ptrdiff_t>(dy) * view.camera.width;
      for (int dx = -kRadius; dx <= kRadius; ++dx) {
        const int32_t similarity = similarity_[std::abs(view.luma[row + dx] - luma)];
        balance += states[row + dx] ? similarity : -similarity;
      }
    }
    return balance < 0;
  }

  /// Similarity by difference in gray levels, 0…65536: 1 / (1 + (difference / contrast)²).
  int32_t similarity_[256];
};

/// Removes small connected components; adjacent patches are connected if their inverse depths
/// differ by at most `kIslandDepthStep`.
void remove_islands(uint8_t* states, const ck_patch_map& map, int minimum) {
  const int w = map.view.camera.width, h = map.view.camera.height;
  std::vector<uint8_t> visited(static_cast<size_t>(w) * h, 0);
  std::vector<int> island;
  for (int start = 0; start < w * h; ++start) {
    if (!states[start] || visited[start]) continue;
    island.assign(1, start);
    visited[start] = 1;
    for (size_t next = 0; next < island.size(); ++next) {
      const int cell = island[next], x = cell % w, y = cell / w;
      const float depth = map.patches[cell].inverse_depth;
      const int around[4] = {x > 0 ? cell - 1 : -1, x + 1 < w ? cell + 1 : -1,
                             y > 0 ? cell - w : -1, y + 1 < h ? cell + w : -1};
      for (int other : around) {
        if (other < 0 || visited[other] || !states[other]) continue;
        if (std::abs(map.patches[other].inverse_depth - depth) > kIslandDepthStep * depth) continue;
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

ck_status ck_patches_filter(const ck_patch_map* reference, const ck_patch_map* neighbors,
                            size_t neighbor_count, const ck_patch_filter_options* options,
                            const ck_control* control, uint8_t* states, uint8_t* visibility) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(states && reference && options && (neighbors || neighbor_count == 0),
                "missing argument");
    ck::require(!visibility || neighbor_count <= kMaximumSources, "at most 8 neighbors");
    VisibilityFilter(*reference, neighbors, neighbor_count, *options)
        .run(states, visibility, control);
    const DepthEdgeFilter depth_edges(options->depth_edge_contrast);
    for (int pass = 0; pass < options->depth_edge_passes; ++pass) {
      depth_edges.remove(states, reference->view);
    }
    remove_islands(states, *reference, options->minimum_island_size);
  });
}
