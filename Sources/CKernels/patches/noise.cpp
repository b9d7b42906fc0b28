#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

#include "ck_patches.h"

float ck_patches_noise(const uint8_t* luma, int32_t width, int32_t height) {
  // Pixels outside kBlack…kWhite are under- or overexposed and show no noise. Chosen.
  constexpr int kBins = 256, kBlack = 4, kWhite = 251;
  // Bounds of the result in gray levels. Limit: the standard deviation of rounding, 1 / √12. The
  // upper one was chosen.
  constexpr float kRounding = 0.29f, kLargest = 8;
  // Few photos have regions without any texture: this factor corrects for the texture in the
  // quantile. Chosen: by trial.
  constexpr float kShare = 0.6f;
  // The quantile was chosen: few pixels show no texture. Limit: 10 % of a normal distribution lie
  // within ±0.1257 standard deviations; the gain of Immerkær's mask for white noise is 6.
  constexpr float kQuantile = 0.1f, kDeviation = 6 * 0.1257f;
  std::array<size_t, kBins> counts{};
  size_t total = 0;
  const ptrdiff_t w = width;
  for (int y = 1; y + 1 < height; y += 2) {
    const uint8_t* p = luma + y * w;
    for (int x = 1; x + 1 < w; x += 2) {
      if (p[x] < kBlack || p[x] > kWhite) continue;
      const int corners = p[x - w - 1] + p[x - w + 1] + p[x + w - 1] + p[x + w + 1];
      const int sides = p[x - w] + p[x - 1] + p[x + 1] + p[x + w];
      ++counts[std::min(kBins - 1, std::abs(corners - 2 * sides + 4 * p[x]))];
      ++total;
    }
  }
  const auto wanted = static_cast<size_t>(kQuantile * static_cast<float>(total));
  size_t below = 0;
  int bin = 0;
  while (bin + 1 < kBins && below + counts[bin] <= wanted) below += counts[bin++];
  const float part = counts[bin] ? static_cast<float>(wanted - below) / counts[bin] : 0;
  // Bin 0 covers half the interval of the other bins.
  const float edge = bin == 0 ? 0.5f * part : bin - 0.5f + part;
  return std::clamp(kShare * edge / kDeviation, kRounding, kLargest);
}
