#pragma once

#include "patches/constants.h"
#include "patches/view.h"

namespace ck::patches {

/// A plane over the pixel grid: inverse depth at a pixel center and its gradient per pixel.
struct Plane {
  float w = 0, gx = 0, gy = 0;

  /// The same plane, evaluated at the pixel (dx, dy) away.
  Plane at(float dx, float dy) const { return {w + gx * dx + gy * dy, gx, gy}; }
};

/// Bit mask of all sources. Limit: the bits of a byte.
constexpr uint8_t kAllSources = 0xff;

/// Number of pixels optimized together: enough to hide memory latency, few enough for the
/// first-level cache. Measured: takes a quarter less time than one at a time on boot at half
/// resolution (docs/experiments/2026-11-dense-stage.md, "Experiments").
constexpr int kWaveSize = 8;

/// The cost where there is no patch. Limit: the largest possible 1 − ZNCC.
constexpr float kNoPatch = 2;

/// Coordinates of a pixel of a grid.
struct Cell {
  int x, y;
};

/// The patches of one reference view at one resolution.
struct Grid {
  int width = 0, height = 0;
  std::vector<Plane> planes;
  /// 1 − ZNCC, averaged over the two best sources.
  std::vector<float> costs;
  /// Bit mask of the sources that each patch is compared with; cells without sources are not
  /// modified.
  std::vector<uint8_t> sources;

  Grid() = default;
  Grid(int w, int h)
      : width(w),
        height(h),
        planes(static_cast<size_t>(w) * h),
        costs(static_cast<size_t>(w) * h, kNoPatch),
        sources(static_cast<size_t>(w) * h, kAllSources) {}

  size_t index(int x, int y) const { return static_cast<size_t>(y) * width + x; }

  /// The plane of the cell (dx, dy) away, evaluated at this one; no plane if that cell has none.
  Plane plane_from(const Cell& cell, int dx, int dy) const {
    const Plane& plane = planes[index(cell.x + dx, cell.y + dy)];
    return plane.w > 0 ? plane.at(static_cast<float>(-dx), static_cast<float>(-dy)) : Plane();
  }

  /// Loads planes and costs from patches.
  void read(const ck_patch* patches);
  /// Stores planes and costs as patches.
  void write(ck_patch* patches) const;
};

/// The input for scoring the patches of one reference at one resolution.
struct Comparison {
  int width = 0, height = 0;
  const uint8_t* luma = nullptr;
  Warps warps;
  float bilateral_contrast = 6;
  /// Fronto-parallel patches: planes have no gradient.
  bool is_fronto_parallel = false;
  /// Variance of the luma noise in gray levels squared.
  float noise_variance = 1;
  /// Bounds of a patch's inverse depth.
  float minimum_w = 0, maximum_w = 0;
  /// Largest rate at which a projected pixel moves with inverse depth, in pixels of a source per
  /// unit of inverse depth.
  float motion = 0;
  /// Focal lengths and principal point in pixels, to limit the slant.
  float fx = 1, fy = 1, cx = 0, cy = 0;
};

/// The normalized 16 texels of the reference, computed once for all planes tested at a pixel.
struct alignas(64) ReferencePatch {
  /// weight · (gray − mean) / deviation; sums to 0.
  float weighted[kTexels];
  float weight[kTexels];
  /// (gray − mean) / deviation.
  float value[kTexels];
  /// Image gradient per pixel, divided by the deviation.
  float gradient_x[kTexels], gradient_y[kTexels];
  /// deviation / sqrt(variance + noise variance), in 0…1: attenuates the correlation of weak
  /// texture.
  float confidence;
};

/// Source samples under a plane: computed by `score`, used by `step`.
///
/// Sources are arranged in eight slots, four per group; a vector holds a row of four texels for
/// each source of a group.
struct alignas(64) Samples {
  /// Gray values by group and row.
  float values[2][4][16];
  float mean[8], inverse_deviation[8];
  /// Derivative of the patch's position with respect to inverse depth, in pixels of the reference.
  float motion_x[8], motion_y[8];
  int group_count = 0;
  /// Bit mask of the slots whose sources see the patch unoccluded; only these contribute to `step`.
  unsigned visible_slots = 0;
};

/// A plane to score at a pixel, and its cost: 1 − ZNCC, averaged over the two best sources.
struct Trial {
  const ReferencePatch* patch;
  Samples* samples;
  Plane plane;
  Cell cell;
  /// Bit mask of the sources to compare with.
  unsigned sources;
  float cost;
};

/// The inner loops, compiled for each instruction set.
struct Kernels {
  /// Normalizes the reference texels. `support` holds an additional weight per texel, or null for
  /// uniform weights.
  void (*prepare)(ReferencePatch& patch, const Comparison& comparison, const Cell& cell,
                  const float* support);
  /// Scores at most `kWaveSize` planes of different pixels.
  void (*score)(const Comparison& comparison, Trial* trials, int count);
  /// One Gauss–Newton step on inverse depth and gradient over the visible slots, which were scored
  /// at `plane`. False if they do not determine a step.
  bool (*step)(const ReferencePatch& patch, const Samples& samples, const Plane& plane,
               Plane& result);
};

/// The kernels of an instruction set. Throws if the processor does not support it.
const Kernels& kernels(ck_instructions instructions);
const Kernels& portable_kernels();
const Kernels& avx2_kernels();
const Kernels& avx512_kernels();

/// True if the plane is within the inverse depth bounds and its angle of incidence is not grazing.
inline bool is_plausible(const Comparison& c, int x, int y, const Plane& p) {
  if (!(p.w >= c.minimum_w && p.w <= c.maximum_w)) return false;
  const float rx = (x + 0.5f - c.cx) / c.fx, ry = (y + 0.5f - c.cy) / c.fy;
  const float nx = p.gx * c.fx, ny = p.gy * c.fy;
  const float nz = p.w + p.gx * (c.cx - x - 0.5f) + p.gy * (c.cy - y - 0.5f);
  const float normal2 = nx * nx + ny * ny + nz * nz;
  const float ray2 = rx * rx + ry * ry + 1;
  return p.w * p.w > kGrazingCosine * kGrazingCosine * normal2 * ray2;
}

}  // namespace ck::patches
