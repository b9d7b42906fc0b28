#include "refinement/luma_pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "core/halve.h"
#include "core/opencv.h"

namespace ck {
namespace {

/// Largest number of levels. Chosen: templates are hardly eight times as coarse as the photo.
constexpr int kLevels = 4;
/// Smallest side in pixels of a level that is halved once more. Chosen: half of it holds a
/// template.
constexpr int kMinimumSide = 32;

using Float4 = float __attribute__((vector_size(16)));
using Byte4 = uint8_t __attribute__((vector_size(4)));

inline Float4 load(const uint8_t* pixels) {
  Byte4 bytes;
  std::memcpy(&bytes, pixels, sizeof bytes);
  return __builtin_convertvector(bytes, Float4);
}

/// Weights of four adjacent pixels (Keys, "Cubic convolution interpolation", 1981).
inline Float4 cubic_weights(float t) {
  return Float4{((-0.5f * t + 1) * t - 0.5f) * t, (1.5f * t - 2.5f) * t * t + 1,
                ((-1.5f * t + 2) * t + 0.5f) * t, (0.5f * t - 0.5f) * t * t};
}

}  // namespace

LumaPyramid::LumaPyramid(const uint8_t* pixels, int width, int height, int channels,
                         size_t stride) {
  Level base{width, height, std::vector<uint8_t>(static_cast<size_t>(width) * height)};
  const cv::Mat photo(height, width, CV_8UC(channels), const_cast<uint8_t*>(pixels), stride);
  cv::Mat luma(height, width, CV_8UC1, base.pixels.data());
  if (channels == 1) {
    photo.copyTo(luma);
  } else {
    on_one_thread([&] {
      cv::cvtColor(photo, luma, channels == 4 ? cv::COLOR_RGBA2GRAY : cv::COLOR_RGB2GRAY);
    });
  }
  levels_.push_back(std::move(base));
  while (levels_.size() < kLevels &&
         std::min(levels_.back().width, levels_.back().height) >= kMinimumSide) {
    add_half();
  }
}

void LumaPyramid::add_half() {
  const Level& full = levels_.back();
  Level half{full.width / 2, full.height / 2, {}};
  half.pixels.resize(static_cast<size_t>(half.width) * half.height);
  halve(full.pixels.data(), full.width, full.height, half.pixels.data());
  levels_.push_back(std::move(half));
}

int LumaPyramid::level_for(double spacing) const {
  int level = 0;
  while (level + 1 < static_cast<int>(levels_.size()) && spacing >= 2) {
    spacing /= 2;
    ++level;
  }
  return level;
}

bool LumaPyramid::sample_grid(int level, double x, double y, double ax, double ay, double bx,
                              double by, int side, float* values) const {
  const Level& image = levels_[static_cast<size_t>(level)];
  const double factor = 1.0 / (1 << level), half = (side - 1) / 2.0;
  // From the corner of the full image to the center of this level's first pixel.
  const double cx = x * factor - 0.5, cy = y * factor - 0.5;
  ax *= factor, ay *= factor, bx *= factor, by *= factor;
  const double reach_x = half * (std::abs(ax) + std::abs(bx));
  const double reach_y = half * (std::abs(ay) + std::abs(by));
  if (!(cx - reach_x >= 1 && cy - reach_y >= 1 && cx + reach_x < image.width - 2 &&
        cy + reach_y < image.height - 2)) {
    return false;
  }
  const size_t stride = static_cast<size_t>(image.width);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const float px = static_cast<float>(cx + (i - half) * ax + (j - half) * bx);
      const float py = static_cast<float>(cy + (i - half) * ay + (j - half) * by);
      const int column = static_cast<int>(px), row = static_cast<int>(py);
      const uint8_t* p = image.pixels.data() + static_cast<size_t>(row - 1) * stride + column - 1;
      const Float4 wx = cubic_weights(px - static_cast<float>(column));
      const Float4 wy = cubic_weights(py - static_cast<float>(row));
      const Float4 sum = (load(p) * wy[0] + load(p + stride) * wy[1] +
                          load(p + 2 * stride) * wy[2] + load(p + 3 * stride) * wy[3]) *
                         wx;
      *values++ = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
  }
  return true;
}

}  // namespace ck
