#include "refinement/luma_pyramid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/halve.h"
#include "core/instructions.h"
#include "core/opencv.h"

namespace ck {
namespace {

/// Largest number of levels. Chosen: templates are hardly eight times as coarse as the photo.
constexpr int kLevels = 4;
/// Smallest side in pixels of a level that is halved once more. Chosen: half of it holds a
/// template.
constexpr int kMinimumSide = 32;

}  // namespace

LumaPyramid::LumaPyramid(const uint8_t* pixels, int width, int height, int channels, size_t stride,
                         ck_instructions instructions)
    : sampler_(chosen_instructions(instructions) == ck_instructions_portable ? sample_cubic
                                                                             : sample_cubic_avx2) {
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
  sampler_({image.pixels.data(), static_cast<size_t>(image.width), side, cx, cy, ax, ay, bx, by},
           values);
  return true;
}

}  // namespace ck
