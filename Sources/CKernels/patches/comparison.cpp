#include "patches/comparison.h"

#include <algorithm>
#include <cmath>

#include "core/guard.h"

namespace ck::patches {
namespace {

/// The largest rate, over all sources, at which a projected pixel moves with inverse depth (pixels
/// per unit of inverse depth), evaluated at the center of the view and of the inverse depth range.
float largest_motion(const Comparison& c) {
  const float x = 0.5f * c.width, y = 0.5f * c.height, w = 0.5f * (c.minimum_w + c.maximum_w);
  float largest = 0;
  for (int s = 0; s < c.warps.count; ++s) {
    float q[3], e[3];
    for (int i = 0; i < 3; ++i) {
      e[i] = c.warps.epipole[i][s];
      q[i] = c.warps.base[i][s] + x * c.warps.column0[i][s] + y * c.warps.column1[i][s] + w * e[i];
    }
    if (!(q[2] > 0)) continue;
    const float du = (e[0] - q[0] / q[2] * e[2]) / q[2], dv = (e[1] - q[1] / q[2] * e[2]) / q[2];
    largest = std::max(largest, std::sqrt(du * du + dv * dv));
  }
  return largest;
}

/// The image of a view and its successive halves, the full resolution first.
std::vector<Image> pyramid(const ck_patch_view& view, int levels) {
  std::vector<Image> images = {image_of(view)};
  for (int level = 1; level < levels; ++level) images.push_back(half(images.back()));
  return images;
}

}  // namespace

Pyramids::Pyramids(const ck_patch_view& reference, const ck_patch_view* sources, size_t count,
                   int levels)
    : reference_(reference), sources_(sources) {
  images_.push_back(pyramid(reference, levels));
  for (size_t i = 0; i < count; ++i) images_.push_back(pyramid(sources[i], levels));
}

Comparison Pyramids::compare(int level, const InverseDepthRange& range, float margin,
                             const ck_patch_options& options) const {
  const double scale = 1.0 / (1 << level);
  const Image& image = images_[0][level];
  Comparison c;
  c.width = image.width;
  c.height = image.height;
  c.luma = image.luma.data();
  c.bilateral_contrast = options.bilateral_contrast;
  c.is_fronto_parallel = options.is_fronto_parallel;
  // Averaging 2 × 2 pixels halves the standard deviation of the noise.
  const double noise = reference_.noise * scale;
  c.noise_variance = static_cast<float>(noise * noise);
  c.minimum_w = range.lowest / margin;
  c.maximum_w = range.highest * margin;
  c.fx = static_cast<float>(reference_.camera.fx * scale);
  c.fy = static_cast<float>(reference_.camera.fy * scale);
  c.cx = static_cast<float>(reference_.camera.cx * scale);
  c.cy = static_cast<float>(reference_.camera.cy * scale);
  for (size_t s = 0; s + 1 < images_.size(); ++s) {
    add_source(c.warps, reference_, sources_[s], scale, images_[s + 1][level]);
  }
  c.motion = largest_motion(c);
  return c;
}

/// Smallest side in pixels of a view. Chosen: less hardly has a patch inside the margins.
constexpr int kMinimumViewSide = 16;

void check_views(const ck_patch_view& reference, size_t source_count) {
  require(source_count >= 1 && source_count <= kMaximumSources, "1 to 8 sources are needed");
  require(std::min(reference.camera.width, reference.camera.height) >= kMinimumViewSide,
          "the view is too small");
}

}  // namespace ck::patches
