#include "patches/smooth.h"

#include <algorithm>
#include <vector>

namespace ck::patches {
namespace {

/// Information (inverse disparity variance, in pixels⁻² up to a factor) above which patches are not
/// smoothed. Chosen: by trial.
constexpr float kSufficient = 1.5f;
/// Weight of a patch's current estimate relative to those of its neighbors. Chosen: by trial.
constexpr float kSelfWeight = 0.1f;
/// Disparity difference in standard deviations above which a patch belongs to another surface.
/// Chosen: by trial.
constexpr float kOutlierDeviations = 5;
/// Number of averaging passes; the spacing of the averaged patches doubles with each. Chosen: by
/// trial.
constexpr int kPasses = 4;

/// Lower bound of the information of a patch. Chosen: by trial.
constexpr float kMinimumInformation = 0.05f;
/// Radius in pixels of the window in which texture is measured. Limit: the largest offset of a
/// patch's texels.
constexpr int kRadius = 2;

/// Variance of the noise in gray levels squared, at least: of rounding and compression. Chosen.
constexpr float kMinimumNoise = 1;

/// The Fisher information of the texture about disparity: the inverse of its variance in pixels
/// squared, up to a factor. The energy of the image gradient around the patch divided by that of
/// the residual that the patch does not explain.
class Information {
 public:
  Information(const Grid& grid, const uint8_t* luma)
      : grid_(grid), luma_(luma), energy_(grid.width), gray_(grid.width), square_(grid.width) {}

  /// Computes a row; zero where there is no patch, and at the border.
  void read(float* result, int y) {
    const int w = grid_.width;
    std::fill(result, result + w, 0.0f);
    if (y < kMargin || y >= grid_.height - kMargin) return;
    sum_columns(y);
    const float* costs = &grid_.costs[grid_.index(0, y)];
    const Plane* planes = &grid_.planes[grid_.index(0, y)];
    for (int x = kMargin; x < w - kMargin; ++x) {
      int energy = 0, gray = 0, square = 0;
      for (int i = x - kRadius; i <= x + kRadius; ++i) {
        energy += energy_[i];
        gray += gray_[i];
        square += square_[i];
      }
      // Limit: the share of a pixel in the window.
      constexpr float kTexel = 1.0f / ((2 * kRadius + 1) * (2 * kRadius + 1));
      const float mean = gray * kTexel, variance = square * kTexel - mean * mean;
      // The unexplained variance is noise, too.
      const float noise = kMinimumNoise + 2 * std::min(1.0f, costs[x]) * variance;
      const float information = kMinimumInformation + 0.25f * kTexel * energy / noise;
      result[x] = planes[x].w > 0 && costs[x] < kNoPatch ? information : 0;
    }
  }

 private:
  void sum_columns(int y) {
    const int w = grid_.width;
    std::fill(energy_.begin(), energy_.end(), 0);
    std::fill(gray_.begin(), gray_.end(), 0);
    std::fill(square_.begin(), square_.end(), 0);
    for (int j = y - kRadius; j <= y + kRadius; ++j) {
      const uint8_t* p = luma_ + static_cast<ptrdiff_t>(j) * w;
      for (int x = 1; x + 1 < w; ++x) {
        const int gx = p[x + 1] - p[x - 1], gy = p[x + w] - p[x - w], value = p[x];
        energy_[x] += gx * gx + gy * gy;
        gray_[x] += value;
        square_[x] += value * value;
      }
    }
  }

  const Grid& grid_;
  const uint8_t* luma_;
  std::vector<int32_t> energy_, gray_, square_;
};

/// Number of patches that are smoothed together. Chosen: a few vectors.
constexpr int kBlock = 32;

/// A row of patches as a structure of arrays, with padding for missing neighbors on both sides.
struct Row {
  static constexpr int kPadding = 1 << (kPasses - 1);  // Limit: the spacing of the last pass.

  explicit Row(int width)
      : w(width + kBlock + 2 * kPadding), gx(w.size()), gy(w.size()), information(w.size()) {}

  void read(const Plane* planes, const float* known, int width) {
    for (int x = 0; x < width; ++x) {
      w[x + kPadding] = planes[x].w;
      gx[x + kPadding] = planes[x].gx;
      gy[x + kPadding] = planes[x].gy;
      information[x + kPadding] = known[x];
    }
  }

  void clear() { std::fill(information.begin(), information.end(), 0.0f); }

  std::vector<float> w, gx, gy, information;
};

/// Weighted sums of the corrections of a block of patches.
struct Sums {
  float weight[kBlock], w[kBlock], gx[kBlock], gy[kBlock];
};

/// Adds the corrections that the patches (dx, dy) away, stored in `there`, imply for those of
/// `here` from `x` on.
void add(Sums& sums, const Row& here, const Row& there, int x, int dx, float dy, float scale) {
  const float *w0 = &here.w[x], *gx0 = &here.gx[x], *gy0 = &here.gy[x], *i0 = &here.information[x];
  const float *w1 = &there.w[x + dx], *gx1 = &there.gx[x + dx], *gy1 = &there.gy[x + dx],
              *i1 = &there.information[x + dx];
  const float half_x = 0.5f * dx, half_y = 0.5f * dy;
  for (int i = 0; i < kBlock; ++i) {
    // Extrapolating with the mean of both gradients is exact for a quadric.
    const float w = w1[i] - w0[i] - half_x * (gx0[i] + gx1[i]) - half_y * (gy0[i] + gy1[i]);
    const float far = std::max(0.0f, 1 - w * w * scale * std::min(i0[i], i1[i]));
    const float weight = far * far * i1[i];
    sums.weight[i] += weight;
    sums.w[i] += weight * w;
    sums.gx[i] += weight * (gx1[i] - gx0[i]);
    sums.gy[i] += weight * (gy1[i] - gy0[i]);
  }
}

/// Averages each patch with the four patches at distance `reach`.
class Pass {
 public:
  Pass(Grid& grid, const std::vector<float>& information, int reach, float scale)
      : grid_(grid),
        information_(information),
        reach_(reach),
        scale_(scale),
        rows_(2 * reach + 1, Row(grid.width)) {}

  void run() {
    for (int y = 0; y < grid_.height + reach_; ++y) {
      Row& next = row(y);
      if (y < grid_.height) {
        next.read(&grid_.planes[grid_.index(0, y)], &information_[grid_.index(0, y)], grid_.width);
      } else {
        next.clear();
      }
      if (y >= reach_) average(y - reach_);
    }
  }

 private:
  /// Rows above the first one are empty: their slots have not been filled yet.
  Row& row(int y) {
    const int count = 2 * reach_ + 1;
    return rows_[static_cast<size_t>((y + count) % count)];
  }

  /// The smoothing strength of each patch of a block, 0…1; false if all are 0.
  static bool weigh(const float* information, float* shares) {
    float most = 0;
    for (int i = 0; i < kBlock; ++i) {
      const float share = information[i] > 0 ? std::max(0.0f, 1 - information[i] / kSufficient) : 0;
      shares[i] = share * share;
      most = std::max(most, share);
    }
    return most > 0;
  }

  void average(int y) {
    const Row& here = row(y);
    const auto dy = static_cast<float>(reach_);
    for (int start = 0; start < grid_.width; start += kBlock) {
      const int x = start + Row::kPadding;
      float shares[kBlock];
      if (!weigh(&here.information[x], shares)) continue;
      Sums sums = {};
      add(sums, here, row(y - reach_), x, 0, -dy, scale_);
      add(sums, here, row(y + reach_), x, 0, dy, scale_);
      add(sums, here, here, x, -reach_, 0, scale_);
      add(sums, here, here, x, reach_, 0, scale_);
      correct(start, y, sums, shares, &here.information[x]);
    }
  }

  void correct(int start, int y, const Sums& sums, const float* shares, const float* information) {
    Plane* planes = &grid_.planes[grid_.index(start, y)];
    const int count = std::min(kBlock, grid_.width - start);
    for (int i = 0; i < count; ++i) {
      if (!(shares[i] > 0)) continue;
      const float factor = shares[i] / (sums.weight[i] + kSelfWeight * information[i]);
      const float w = planes[i].w + factor * sums.w[i];
      if (!(w > 0)) continue;
      planes[i].w = w;
      planes[i].gx += factor * sums.gx[i];
      planes[i].gy += factor * sums.gy[i];
    }
  }

  Grid& grid_;
  const std::vector<float>& information_;
  const int reach_;
  const float scale_;
  std::vector<Row> rows_;
};

}  // namespace

void smooth(Grid& grid, const Comparison& comparison) {
  std::vector<float> information(grid.planes.size());
  Information reader(grid, comparison.luma);
  for (int y = 0; y < grid.height; ++y) reader.read(&information[grid.index(0, y)], y);
  const float scale = comparison.motion / kOutlierDeviations;
  for (int pass = 0; pass < kPasses; ++pass)
    Pass(grid, information, 1 << pass, scale * scale).run();
}

}  // namespace ck::patches
