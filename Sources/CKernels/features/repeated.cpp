#include "ck_matching.h"
#include "core/guard.h"
#include "features/nearest.h"

namespace ck {
namespace {

/// The features of a photo among which one is searched for again.
class FeatureWindows {
 public:
  FeatureWindows(const uint8_t* descriptors, const float* positions, const float* scales,
                 size_t count, const ck_repetition_options& options)
      : descriptors_(descriptors),
        positions_(positions),
        scales_(scales),
        count_(count),
        radius_(options.window_radius),
        limit_(options.maximum_distance * options.maximum_distance),
        distance_(ck_instructions_supported(ck_instructions_avx2) ? squared_distance_avx2
                                                                  : squared_distance) {}

  /// Whether another feature looks like feature `i`.
  bool is_repeated(size_t i) const {
    const uint8_t* descriptor = descriptors_ + i * kDescriptorLength;
    for (size_t j = 0; j < count_; ++j) {
      if (distance_(descriptor, descriptors_ + j * kDescriptorLength) <= limit_ && !overlap(i, j)) {
        return true;
      }
    }
    return false;
  }

 private:
  /// Whether the windows of two features overlap.
  bool overlap(size_t i, size_t j) const {
    const double dx = positions_[2 * i] - positions_[2 * j];
    const double dy = positions_[2 * i + 1] - positions_[2 * j + 1];
    const double reach = radius_ * (scales_[i] + scales_[j]);
    return dx * dx + dy * dy < reach * reach;
  }

  const uint8_t* descriptors_;
  const float* positions_;
  const float* scales_;
  size_t count_;
  double radius_, limit_;
  uint32_t (*distance_)(const uint8_t*, const uint8_t*);
};

}  // namespace
}  // namespace ck

ck_status ck_find_repeated_features(const uint8_t* descriptors, const float* positions,
                                    const float* scales, size_t count, const int32_t* queries,
                                    size_t query_count, const ck_repetition_options* options,
                                    const ck_control* control, uint8_t* is_repeated) {
  return ck::guarded([&] {
    ck::require(options, "options are needed");
    const ck::FeatureWindows windows(descriptors, positions, scales, count, *options);
    for (size_t n = 0; n < query_count; ++n) {
      if (n % 256 == 0) ck::step(control, static_cast<double>(n) / query_count);
      ck::require(queries[n] >= 0 && static_cast<size_t>(queries[n]) < count,
                  "a feature index is out of range");
      is_repeated[n] = windows.is_repeated(static_cast<size_t>(queries[n]));
    }
  });
}
