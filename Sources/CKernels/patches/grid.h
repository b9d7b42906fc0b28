#pragma once

#include "patches/view.h"

namespace ck::patches {

/// A plane over the pixel grid: inverse depth at a pixel's centre and its gradient.
struct Plane {
  float w = 0, gx = 0, gy = 0;

  /// The same plane seen from the pixel (dx, dy) away.
  Plane at(float dx, float dy) const { return {w + gx * dx + gy * dy, gx, gy}; }
};

/// The least that a patch of weak texture costs: nothing grows from it into holes.
constexpr float kWeakCost = 0.4f;

/// All sources, a bit each.
constexpr uint8_t kAllSources = 0xff;

/// The most pixels that are optimised at once: enough to hide what each waits for, few enough for
/// the nearest cache.
constexpr int kWaveSize = 8;

/// The cost of no patch.
constexpr float kNoPatch = 2;

/// A pixel of a grid.
struct Cell {
  int x, y;
};

/// The patches of one reference view at one resolution.
struct Grid {
  int width = 0, height = 0;
  std::vector<Plane> planes;
  /// The mean of the best two sources' 1 − ZNCC.
  std::vector<float> costs;
  /// The sources that a patch is compared with, a bit each; cells with none stay as they are.
  std::vector<uint8_t> sources;

  Grid() = default;
  Grid(int w, int h)
      : width(w),
        height(h),
        planes(static_cast<size_t>(w) * h),
        costs(static_cast<size_t>(w) * h, kNoPatch),
        sources(static_cast<size_t>(w) * h, kAllSources) {}

  size_t index(int x, int y) const { return static_cast<size_t>(y) * width + x; }

  /// The plane of the cell (dx, dy) away, seen from this one; no plane where that has none.
  Plane plane_from(const Cell& cell, int dx, int dy) const {
    const Plane& plane = planes[index(cell.x + dx, cell.y + dy)];
    return plane.w > 0 ? plane.at(static_cast<float>(-dx), static_cast<float>(-dy)) : Plane();
  }

  void read(const ck_patch* patches);
  void write(ck_patch* patches) const;
};

/// All that scoring a patch of one reference needs at one resolution.
struct Comparison {
  int width = 0, height = 0;
  const uint8_t* luma = nullptr;
  Warps warps;
  float bilateral_contrast = 6;
  /// Planes have no gradient.
  bool is_frontal = false;
  /// Variance of the photos' noise.
  float noise_variance = 1;
  /// Inverse depths between which a patch may lie.
  float minimum_w = 0, maximum_w = 0;
  /// Pixels by which a source moves, at most, with inverse depth.
  float motion = 0;
  /// Focal lengths and principal point, to bound the slant.
  float fx = 1, fy = 1, cx = 0, cy = 0;
};

/// The reference's 16 texels, normalised, once for all planes tried at a pixel.
struct alignas(64) ReferencePatch {
  /// weight · (grey − mean) / deviation; sums to 0.
  float weighted[kTexels];
  float weight[kTexels];
  /// (grey − mean) / deviation.
  float value[kTexels];
  /// Gradient in units of the deviation a pixel.
  float gradient_x[kTexels], gradient_y[kTexels];
  /// deviation / sqrt(variance + noise): what weak texture takes off the correlation.
  float confidence;
};

/// What the sources show where a plane puts the patch: computed with the score, used by the step.
///
/// Sources stand in eight slots, four a group; a vector holds a row of four texels for each of a
/// group.
struct alignas(64) Samples {
  /// Grey values by row.
  float values[2][4][16];
  float mean[8], inverse_deviation[8];
  /// Motion of the patch with inverse depth, in pixels of the reference.
  float motion_x[8], motion_y[8];
  int group_count = 0;
  /// The slots of the sources that see the patch well, a bit each: they move it.
  unsigned voters = 0;
};

/// A plane to be scored for a pixel, and its cost: the mean of the best two sources' 1 − ZNCC.
struct Trial {
  const ReferencePatch* patch;
  Samples* samples;
  Plane plane;
  Cell cell;
  /// A bit mask of the sources to compare with.
  unsigned sources;
  float cost;
};

/// The inner loops, compiled for each instruction set.
struct Kernels {
  /// `support` says how much each texel counts besides, null for all alike.
  void (*prepare)(ReferencePatch& patch, const Comparison& comparison, const Cell& cell,
                  const float* support);
  /// Scores at most `kWaveSize` planes of different pixels.
  void (*score)(const Comparison& comparison, Trial* trials, int count);
  /// One Gauss–Newton step on inverse depth and gradient over the voters, which were scored at
  /// `plane`. False where they do not determine one.
  bool (*step)(const ReferencePatch& patch, const Samples& samples, const Plane& plane,
               Plane& result);
};

/// The kernels for the instructions. Throws where the processor lacks them.
const Kernels& kernels(ck_instructions instructions);
const Kernels& portable_kernels();
const Kernels& avx2_kernels();
const Kernels& avx512_kernels();

/// True when the plane faces the camera by more than a grazing angle and lies within the bounds.
inline bool is_plausible(const Comparison& c, int x, int y, const Plane& p) {
  if (!(p.w >= c.minimum_w && p.w <= c.maximum_w)) return false;
  const float rx = (x + 0.5f - c.cx) / c.fx, ry = (y + 0.5f - c.cy) / c.fy;
  const float nx = p.gx * c.fx, ny = p.gy * c.fy;
  const float nz = p.w + p.gx * (c.cx - x - 0.5f) + p.gy * (c.cy - y - 0.5f);
  const float normal2 = nx * nx + ny * ny + nz * nz;
  const float ray2 = rx * rx + ry * ry + 1;
  constexpr float kGrazing = 0.17f;  // cosine of 80°
  return p.w * p.w > kGrazing * kGrazing * normal2 * ray2;
}

}  // namespace ck::patches
