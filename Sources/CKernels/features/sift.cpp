#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "ck_features.h"
#include "core/guard.h"
#include "features/selection.h"

namespace ck {
namespace {

/// OpenCV doubles the photo about pixel centres but halves positions about the corner.
constexpr float kUpsamplingBias = 0.25f;
/// From OpenCV's pixel centres to corners.
constexpr float kCornerFromCenter = 0.5f;

cv::Mat gray_image(const uint8_t* pixels, int width, int height, int channels, size_t stride) {
  const cv::Mat image(height, width, CV_8UC(channels), const_cast<uint8_t*>(pixels), stride);
  cv::Mat gray;
  if (channels == 1) {
    gray = image;
  } else {
    cv::cvtColor(image, gray, channels == 3 ? cv::COLOR_RGB2GRAY : cv::COLOR_RGBA2GRAY);
  }
  return gray;
}

/// A total order: largest scale first, so that a prefix is a coarse description of the photo.
bool larger_scale_first(const cv::KeyPoint& a, const cv::KeyPoint& b) {
  if (a.size != b.size) return a.size > b.size;
  if (a.pt.y != b.pt.y) return a.pt.y < b.pt.y;
  if (a.pt.x != b.pt.x) return a.pt.x < b.pt.x;
  return a.angle < b.angle;
}

void write_root_sift(const float* descriptor, uint8_t* bytes) {
  float sum = 0;
  for (int k = 0; k < CK_DESCRIPTOR_LENGTH; ++k) sum += std::abs(descriptor[k]);
  const float factor = sum > 0 ? 1 / sum : 0;
  for (int k = 0; k < CK_DESCRIPTOR_LENGTH; ++k) {
    const float value = 512 * std::sqrt(std::abs(descriptor[k]) * factor);
    bytes[k] = static_cast<uint8_t>(std::min(255.0f, std::round(value)));
  }
}

void write_color(const uint8_t* pixels, int width, int height, int channels, size_t stride, float x,
                 float y, uint8_t* color) {
  const int column = std::clamp(static_cast<int>(x), 0, width - 1);
  const int row = std::clamp(static_cast<int>(y), 0, height - 1);
  const uint8_t* pixel = pixels + row * stride + static_cast<size_t>(column) * channels;
  for (int c = 0; c < 3; ++c) color[c] = pixel[channels >= 3 ? c : 0];
}

struct Detection {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
};

Detection detect(const cv::Mat& gray, const ck_sift_options& options) {
  // Descriptors are made for all that OpenCV returns, so bound them before the grid does.
  const int limit = 2 * options.maximum_features;
  auto sift = cv::SIFT::create(limit, options.octave_layers, options.low_contrast_threshold,
                               options.edge_threshold, options.sigma);
  Detection result;
  sift->detectAndCompute(gray, cv::noArray(), result.keypoints, result.descriptors);
  return result;
}

std::vector<size_t> selected(const std::vector<cv::KeyPoint>& keypoints, int width, int height,
                             const ck_sift_options& options) {
  std::vector<Candidate> candidates;
  candidates.reserve(keypoints.size());
  for (const auto& k : keypoints) {
    candidates.push_back({k.pt.x, k.pt.y, k.response * options.octave_layers});
  }
  Selection selection;
  selection.maximum = static_cast<size_t>(options.maximum_features);
  selection.sufficient = static_cast<size_t>(options.sufficient_features);
  selection.high_threshold = static_cast<float>(options.high_contrast_threshold);
  selection.cells = options.grid_cells;
  std::vector<size_t> kept = select_features(candidates, width, height, selection);
  std::sort(kept.begin(), kept.end(),
            [&](size_t a, size_t b) { return larger_scale_first(keypoints[a], keypoints[b]); });
  return kept;
}

}  // namespace
}  // namespace ck

ck_status ck_sift_detect(const uint8_t* pixels, int32_t width, int32_t height, int32_t channels,
                         size_t row_stride, const ck_sift_options* options,
                         const ck_control* control, float* positions, float* scales,
                         float* orientations, uint8_t* descriptors, uint8_t* colors,
                         size_t color_stride, size_t* count) {
  return ck::guarded([&] {
    ck::require(options && count, "options and count are needed");
    *count = 0;
    ck::require(width >= 0 && height >= 0, "the size is negative");
    ck::require(channels == 1 || channels == 3 || channels == 4, "1, 3 or 4 channels are needed");
    ck::require(row_stride >= static_cast<size_t>(width) * channels, "the row stride is too small");
    ck::require(
        options->maximum_features >= 0 && options->octave_layers > 0 && options->grid_cells > 0,
        "an option is out of range");
    if (width < 8 || height < 8 || options->maximum_features == 0) return;
    ck::step(control, 0);
    const cv::Mat gray = ck::gray_image(pixels, width, height, channels, row_stride);
    const ck::Detection detection = ck::detect(gray, *options);
    size_t n = 0;
    for (size_t index : ck::selected(detection.keypoints, width, height, *options)) {
      const cv::KeyPoint& k = detection.keypoints[index];
      const float x = k.pt.x - ck::kUpsamplingBias + ck::kCornerFromCenter;
      const float y = k.pt.y - ck::kUpsamplingBias + ck::kCornerFromCenter;
      positions[2 * n] = x;
      positions[2 * n + 1] = y;
      scales[n] = k.size / 2;
      orientations[n] = k.angle * static_cast<float>(CV_PI / 180);
      ck::write_root_sift(detection.descriptors.ptr<float>(static_cast<int>(index)),
                          descriptors + n * CK_DESCRIPTOR_LENGTH);
      ck::write_color(pixels, width, height, channels, row_stride, x, y, colors + n * color_stride);
      ++n;
    }
    *count = n;
  });
}
