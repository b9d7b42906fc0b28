#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "ck_matching.h"
#include "core/guard.h"
#include "features/nearest.h"

namespace ck {
namespace {

/// Squared distances of the descriptors of features that lie near each other's epipolar line.
class EpipolarBand {
 public:
  EpipolarBand(const ck_features& first, const ck_features& second,
               const ck_guided_match_options& options)
      : first_(first),
        second_(second),
        matrix_(Eigen::Map<const Matrix>(options.matrix)),
        squared_limit_(options.maximum_error * options.maximum_error),
        is_near_(rounded_up(second.count, kWord)) {
    for (size_t j = 0; j < second.count; ++j) {
      const Eigen::Vector3d point(second.points[2 * j], second.points[2 * j + 1], 1);
      x_.push_back(static_cast<float>(point.x()));
      y_.push_back(static_cast<float>(point.y()));
      slope_.push_back(static_cast<float>((matrix_.transpose() * point).head<2>().squaredNorm()));
    }
  }

  /// Calls `visit(second, squared distance of the descriptors)` for the features near the line of
  /// feature `i`, in ascending order.
  template <typename Visit>
  void visit(size_t i, Visit visit) {
    if (std::isnan(first_.points[2 * i])) return;
    mark(matrix_ * Eigen::Vector3d(first_.points[2 * i], first_.points[2 * i + 1], 1));
    const uint8_t* descriptor = first_.descriptors + i * kDescriptorLength;
    for (size_t begin = 0; begin < is_near_.size(); begin += kWord) {
      uint64_t word;
      std::memcpy(&word, &is_near_[begin], kWord);
      if (word == 0) continue;
      for (size_t j = begin; j < begin + kWord; ++j) {
        if (!is_near_[j]) continue;
        visit(j, squared_distance(descriptor, second_.descriptors + j * kDescriptorLength));
      }
    }
  }

 private:
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  /// Marks that are looked at together.
  static constexpr size_t kWord = sizeof(uint64_t);

  /// Marks the features whose Sampson error to the line is within the limit.
  void mark(const Eigen::Vector3d& line) {
    const auto a = static_cast<float>(line.x()), b = static_cast<float>(line.y());
    const auto c = static_cast<float>(line.z());
    const float slope = a * a + b * b, limit = static_cast<float>(squared_limit_);
    const float *x = x_.data(), *y = y_.data(), *own_slope = slope_.data();
    uint8_t* is_near = is_near_.data();
    for (size_t j = 0, count = x_.size(); j < count; ++j) {
      const float error = a * x[j] + b * y[j] + c;
      is_near[j] = error * error < limit * (slope + own_slope[j]) ? 1 : 0;
    }
  }

  const ck_features& first_;
  const ck_features& second_;
  Matrix matrix_;
  double squared_limit_;
  /// Of the second photo's points: coordinates, and their part of the Sampson error's divisor.
  std::vector<float> x_, y_, slope_;
  std::vector<uint8_t> is_near_;
};

}  // namespace
}  // namespace ck

ck_status ck_match_guided(const ck_features* first, const ck_features* second,
                          const ck_guided_match_options* options, const ck_control* control,
                          int32_t* pairs, size_t* pair_count) {
  return ck::guarded([&] {
    ck::require(first && second && options && pairs && pair_count, "an argument is missing");
    ck::EpipolarBand band(*first, *second, *options);
    ck::NearestTable table{std::vector<ck::NearestTwo>(first->count),
                           std::vector<ck::NearestTwo>(second->count)};
    for (size_t i = 0; i < first->count; ++i) {
      if (i % 256 == 0) ck::step(control, static_cast<double>(i) / first->count);
      band.visit(i, [&](size_t j, uint32_t distance) {
        table.by_row[i].offer(distance, static_cast<uint32_t>(j));
        table.by_column[j].offer(distance, static_cast<uint32_t>(i));
      });
    }
    *pair_count = ck::write_mutual_matches(table, options->ratio, options->maximum_distance, pairs);
  });
}
