#include <algorithm>
#include <cmath>

#include "core/guard.h"
#include "patches/expand.h"
#include "patches/seed.h"

namespace ck::patches {
namespace {

/// The photos of the reference (first) and its sources at all resolutions, the finest first.
std::vector<std::vector<Image>> make_pyramids(const ck_patch_view& reference,
                                              const ck_patch_view* sources, size_t count,
                                              int levels) {
  std::vector<std::vector<Image>> pyramids;
  for (size_t i = 0; i <= count; ++i) {
    const ck_patch_view& view = i == 0 ? reference : sources[i - 1];
    std::vector<Image> pyramid(1);
    pyramid[0].width = view.width;
    pyramid[0].height = view.height;
    pyramid[0].luma.assign(view.luma, view.luma + static_cast<size_t>(view.width) * view.height);
    for (int level = 1; level < levels; ++level) pyramid.push_back(half(pyramid.back()));
    pyramids.push_back(std::move(pyramid));
  }
  return pyramids;
}

/// Twice beyond the nearest and farthest seed.
void bound_depth(Comparison& comparison, const ck_patch_seed* seeds, size_t count) {
  std::vector<float> values;
  for (size_t i = 0; i < count; ++i) {
    const float w = seeds[i].inverse_depth;
    if (w > 0 && std::isfinite(w)) values.push_back(w);
  }
  if (values.empty()) throw Degenerate("the view has no sparse points to start from");
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  comparison.minimum_w = *low * 0.5f;
  comparison.maximum_w = *high * 2;
}

Comparison compare(const ck_patch_view& reference, const ck_patch_view* sources,
                   const std::vector<std::vector<Image>>& pyramids, int level, float noise,
                   const ck_patch_options& options) {
  const double scale = 1.0 / (1 << level);
  const Image& image = pyramids[0][level];
  Comparison c;
  c.width = image.width;
  c.height = image.height;
  c.luma = image.luma.data();
  c.bilateral_contrast = options.bilateral_contrast;
  // Averaging 2 × 2 pixels halves the noise.
  c.noise_variance = static_cast<float>(noise * noise * scale * scale);
  c.kept_sources = options.finest_sources;
  c.fx = static_cast<float>(reference.fx * scale);
  c.fy = static_cast<float>(reference.fy * scale);
  c.cx = static_cast<float>(reference.cx * scale);
  c.cy = static_cast<float>(reference.cy * scale);
  for (size_t s = 0; s + 1 < pyramids.size(); ++s) {
    add_source(c.warps, reference, sources[s], scale, pyramids[s + 1][level]);
  }
  return c;
}

/// The largest motion in a source, in pixels, with the inverse depth of the view's centre.
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

/// The levels that leave the coarsest grid a useful size.
int level_count(const ck_patch_view& reference, const ck_patch_view* sources, size_t count,
                int wanted) {
  int side = std::min(reference.width, reference.height);
  for (size_t i = 0; i < count; ++i) side = std::min({side, sources[i].width, sources[i].height});
  int levels = 1;
  while (levels < wanted && (side >> levels) >= 32) ++levels;
  return levels;
}

void write(ck_patch* patches, const Grid& grid) {
  for (size_t i = 0; i < grid.planes.size(); ++i) {
    const Plane& p = grid.planes[i];
    const bool is_set = p.w > 0 && grid.scores[i].cost < 2;
    patches[i] = is_set ? ck_patch{p.w, p.gx, p.gy, grid.scores[i].cost} : ck_patch{0, 0, 0, 2};
  }
}

/// Seeds, expands and optimises, the coarsest level first.
Grid reconstruct(const ck_patch_view& reference, const ck_patch_view* sources, size_t count,
                 const ck_patch_seed* seeds, size_t seed_count, const ck_patch_options& options,
                 const ck_control* control) {
  const int levels = level_count(reference, sources, count, options.level_count);
  const auto pyramids = make_pyramids(reference, sources, count, levels);
  const float noise = options.noise > 0 ? options.noise : noise_of(pyramids[0][0]);
  Grid grid;
  double progress = 0;
  for (int level = levels - 1; level >= 0; --level) {
    Comparison comparison = compare(reference, sources, pyramids, level, noise, options);
    bound_depth(comparison, seeds, seed_count);
    comparison.motion = largest_motion(comparison);
    const bool is_coarsest = level == levels - 1;
    if (is_coarsest) {
      grid = Grid(comparison.width, comparison.height);
      seed(grid, comparison, seeds, seed_count, 1.0 / (1 << level));
    } else {
      grid = refine_grid(grid, comparison.width, comparison.height);
    }
    const double end = level == 0 ? 1.0 : progress + (1 - progress) * 0.3;
    const int sweeps = is_coarsest ? std::max(1, options.coarse_sweeps) : 1;
    for (int i = 0; i < sweeps; ++i) {
      Sweep sweep;
      sweep.is_forward = (level + i) % 2 == 0;
      sweep.perturbations = is_coarsest ? options.perturbations : 0;
      sweep.refinement_steps = options.refinement_steps;
      sweep.uses_kept_sources = level == 0 && levels > 1;
      sweep.may_inherit = !is_coarsest;
      sweep.seed = options.seed + static_cast<uint32_t>(16 * level + i);
      expand(grid, comparison, kernels(options.instructions), sweep, control,
             progress + (end - progress) * i / sweeps,
             progress + (end - progress) * (i + 1) / sweeps);
    }
    progress = end;
  }
  return grid;
}

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_reconstruct(ck_patch* patches, const ck_patch_view* reference,
                                 const ck_patch_view* sources, size_t source_count,
                                 const ck_patch_seed* seeds, size_t seed_count,
                                 const ck_patch_options* options, const ck_control* control) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(patches && reference && sources && options, "missing argument");
    ck::require(source_count >= 1 && source_count <= kMaxSources, "1 to 8 sources are needed");
    ck::require(std::min(reference->width, reference->height) >= 16, "the view is too small");
    write(patches,
          reconstruct(*reference, sources, source_count, seeds, seed_count, *options, control));
  });
}
