#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "ck_matching.h"
#include "core/guard.h"
#include "features/nearest.h"

namespace ck {
namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// A feature as stored in the grid.
struct GridFeature {
  float x, y;
  /// Its part of the denominator of the squared Sampson error.
  float slope;
  uint32_t index;
};

/// The features of a photo in a grid, in column or row order, to find those near a line quickly.
class FeatureGrid {
 public:
  /// Axis 0: cells are stored column by column, for lines along x; axis 1: row by row.
  FeatureGrid(const std::vector<GridFeature>& features, const Eigen::AlignedBox2d& box, int axis)
      : along_(axis), box_(box), scale_(kCells / box.sizes().cwiseMax(1e-12).array()) {
    std::vector<std::vector<GridFeature>> cells(kCells * kCells);
    for (const GridFeature& f : features) {
      const Eigen::Vector2d point(f.x, f.y);
      cells[cell(axis, point[axis]) * kCells + cell(1 - axis, point[1 - axis])].push_back(f);
    }
    for (const auto& cell : cells) {
      begins_.push_back(features_.size());
      features_.insert(features_.end(), cell.begin(), cell.end());
    }
    begins_.push_back(features_.size());
  }

  /// Calls `visit(feature)` for all features within `margin` of the line a x + b y + c = 0, and for
  /// some beyond.
  template <typename Visit>
  void visit_near(const Eigen::Vector3d& line, double margin, Visit visit) const {
    const int across = 1 - along_;
    // The intersection of the line with the strip borders, in cells.
    const double factor = scale_[across] / line[across];
    const double drift = -line[along_] / scale_[along_] * factor;
    const double reach = std::abs(margin * factor);
    double begin = -(line[along_] * box_.min()[along_] + line.z()) * factor -
                   box_.min()[across] * scale_[across];
    for (int strip = 0; strip < kCells; ++strip, begin += drift) {
      const size_t from = clamped(begin + std::min(0.0, drift) - reach);
      const size_t to = clamped(begin + std::max(0.0, drift) + reach);
      const size_t last = begins_[strip * kCells + to + 1];
      for (size_t i = begins_[strip * kCells + from]; i < last; ++i) visit(features_[i]);
    }
  }

 private:
  /// Cells per side. Chosen: a few features per cell.
  static constexpr int kCells = 64;

  static size_t clamped(double cell) {
    return static_cast<size_t>(std::clamp(cell, 0.0, kCells - 1.0));
  }

  size_t cell(int axis, double coordinate) const {
    return clamped((coordinate - box_.min()[axis]) * scale_[axis]);
  }

  int along_;
  Eigen::AlignedBox2d box_;
  Eigen::Array2d scale_;
  std::vector<GridFeature> features_;
  /// Start of each cell in `features_`, and the end of the last.
  std::vector<size_t> begins_;
};

/// Squared descriptor distances between features near each other's epipolar line.
class EpipolarBand {
 public:
  EpipolarBand(const ck_features& first, const ck_features& second,
               const ck_guided_match_options& options)
      : first_(first),
        second_(second),
        matrix_(Eigen::Map<const Matrix>(options.matrix)),
        limit_(options.maximum_error),
        distance_(ck_instructions_supported(ck_instructions_avx2) ? squared_distance_avx2
                                                                  : squared_distance) {
    std::vector<GridFeature> features;
    Eigen::AlignedBox2d box;
    for (size_t j = 0; j < second.count; ++j) {
      const Eigen::Vector2d point(second.points[2 * j], second.points[2 * j + 1]);
      if (!point.allFinite()) continue;
      const double slope = (matrix_.transpose() * point.homogeneous()).head<2>().squaredNorm();
      steepest_ = std::max(steepest_, slope);
      box.extend(point);
      features.push_back({static_cast<float>(point.x()), static_cast<float>(point.y()),
                          static_cast<float>(slope), static_cast<uint32_t>(j)});
    }
    if (features.empty()) return;
    for (int axis : {0, 1}) grids_.emplace_back(features, box, axis);
  }

  /// Calls `visit(second, squared descriptor distance)` for the features whose Sampson error with
  /// feature `i` is within the limit.
  template <typename Visit>
  void visit(size_t i, Visit visit) const {
    const Eigen::Vector3d line =
        matrix_ * Eigen::Vector3d(first_.points[2 * i], first_.points[2 * i + 1], 1);
    const double slope = line.head<2>().squaredNorm();
    if (grids_.empty() || !line.allFinite() || slope == 0) return;
    const FeatureGrid& grid = grids_[std::abs(line.y()) >= std::abs(line.x()) ? 0 : 1];
    const auto a = static_cast<float>(line.x()), b = static_cast<float>(line.y());
    const auto c = static_cast<float>(line.z()), own = static_cast<float>(slope);
    const auto squared_limit = static_cast<float>(limit_ * limit_);
    const uint8_t* descriptor = first_.descriptors + i * kDescriptorLength;
    grid.visit_near(line, limit_ * std::sqrt(slope + steepest_), [&](const GridFeature& f) {
      const float error = a * f.x + b * f.y + c;
      if (error * error >= squared_limit * (own + f.slope)) return;
      visit(f.index, distance_(descriptor, second_.descriptors + f.index * kDescriptorLength));
    });
  }

 private:
  const ck_features& first_;
  const ck_features& second_;
  Matrix matrix_;
  double limit_;
  uint32_t (*distance_)(const uint8_t*, const uint8_t*);
  /// The second photo's features for lines along x and along y; empty if no feature is included.
  std::vector<FeatureGrid> grids_;
  /// The largest `slope` of the second photo's features.
  double steepest_ = 0;
};

}  // namespace
}  // namespace ck

ck_status ck_match_guided(const ck_features* first, const ck_features* second,
                          const ck_guided_match_options* options, const ck_control* control,
                          int32_t* pairs, size_t* pair_count) {
  return ck::guarded([&] {
    ck::require(first && second && options && pairs && pair_count, "an argument is missing");
    const ck::EpipolarBand band(*first, *second, *options);
    ck::NearestTable table{std::vector<ck::NearestTwo>(first->count),
                           std::vector<ck::NearestTwo>(second->count)};
    for (size_t i = 0; i < first->count; ++i) {
      if (i % 256 == 0) ck::step(control, static_cast<double>(i) / first->count);
      band.visit(i, [&](uint32_t j, uint32_t distance) {
        table.by_row[i].offer(distance, j);
        table.by_column[j].offer(distance, static_cast<uint32_t>(i));
      });
    }
    *pair_count = ck::write_mutual_matches(table, options->ratio, options->maximum_distance, pairs);
  });
}
