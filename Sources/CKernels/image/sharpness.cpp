#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "ck_image.h"
#include "core/guard.h"
#include "core/median.h"
#include "core/opencv.h"

namespace {

/// Side of the blocks in pixels. Chosen.
constexpr int kBlock = 32;
/// Standard deviation in pixels of the blur that the image is compared with. Chosen.
constexpr double kBlur = 1.5;
/// One of this number of blocks is measured, those with the strongest gradients. Chosen: sky and
/// walls contain no information about focus.
constexpr size_t kBlocksPerMeasured = 4;
/// Smallest gradient energy of a block with texture after the blur: the sum over its pixels of the
/// squared differences of the pixels on both sides, in gray levels squared. Chosen: a gray level
/// per pixel.
constexpr double kMinimumTexture = kBlock * kBlock;

/// Structure tensor: sums over a block of the products of the gradient's components.
struct Tensor {
  double xx = 0, yy = 0, xy = 0;

  double trace() const { return xx + yy; }
  double along(double cosine, double sine) const {
    return cosine * cosine * xx + sine * sine * yy + 2 * cosine * sine * xy;
  }
};

Tensor tensor(const cv::Mat& image, int left, int top) {
  Tensor sum;
  const int bottom = std::min(top + kBlock, image.rows - 1);
  const int right = std::min(left + kBlock, image.cols - 1);
  for (int y = std::max(top, 1); y < bottom; ++y) {
    const float* above = image.ptr<float>(y - 1);
    const float* row = image.ptr<float>(y);
    const float* below = image.ptr<float>(y + 1);
    for (int x = std::max(left, 1); x < right; ++x) {
      const double gx = row[x + 1] - row[x - 1];
      const double gy = below[x] - above[x];
      sum.xx += gx * gx;
      sum.yy += gy * gy;
      sum.xy += gx * gy;
    }
  }
  return sum;
}

}  // namespace

ck_status ck_image_sharpness(const ck_pixels* gray, double* sharpness) {
  return ck::guarded([&] {
    const auto [data, width, height, channels, row_stride] = *gray;
    ck::require(width > 0 && height > 0 && channels == 1, "the image has no pixels");
    const cv::Mat bytes(height, width, CV_8U, const_cast<uint8_t*>(data), row_stride);
    cv::Mat image, blurred;
    bytes.convertTo(image, CV_32F);
    ck::on_one_thread([&] { cv::GaussianBlur(image, blurred, cv::Size(), kBlur); });
    struct Block {
      Tensor before, after;
      size_t index;
    };
    std::vector<Block> blocks;
    for (int y = 0; y + kBlock <= height; y += kBlock) {
      for (int x = 0; x + kBlock <= width; x += kBlock) {
        blocks.push_back({tensor(image, x, y), tensor(blurred, x, y), blocks.size()});
      }
    }
    if (blocks.empty()) throw ck::Degenerate("the image is too small to measure its sharpness");
    const size_t used = std::max<size_t>(1, blocks.size() / kBlocksPerMeasured);
    std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) {
      const double x = a.after.trace(), y = b.after.trace();
      return x != y ? x > y : a.index < b.index;
    });
    blocks.resize(used);
    if (blocks.front().after.trace() < kMinimumTexture) {
      throw ck::Degenerate("the image has no texture");
    }
    double least = INFINITY;
    for (const auto& [cosine, sine] : std::array<std::pair<double, double>, 4>{
             {{1, 0}, {0, 1}, {M_SQRT1_2, M_SQRT1_2}, {M_SQRT1_2, -M_SQRT1_2}}}) {
      std::vector<double> ratios;
      for (const Block& b : blocks) {
        const double left = b.after.along(cosine, sine);
        if (left > 0) ratios.push_back(b.before.along(cosine, sine) / left - 1);
      }
      if (!ratios.empty()) least = std::min(least, ck::median(ratios));
    }
    *sharpness = std::isfinite(least) ? least : 0;
  });
}
