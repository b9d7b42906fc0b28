#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/guard.h"
#include "core/random.h"

namespace ck {

/// Options of LO-RANSAC.
struct RansacOptions {
  /// Largest error of an inlier, in the estimator's unit.
  double maximum_error;
  /// Required probability of drawing an outlier-free sample.
  double confidence;
  int minimum_iterations;
  int maximum_iterations;
  uint64_t seed;
};

/// The best model of RANSAC and its inliers.
template <class Model>
struct RansacResult {
  bool found = false;
  Model model;
  /// Σ min(error², limit²)
  double score = std::numeric_limits<double>::max();
  size_t inlier_count = 0;
  int iterations = 0;
};

/// MSAC score and number of inliers of a model; stops early once the score exceeds `bound`.
template <class Estimator>
std::pair<double, size_t> msac_score(const Estimator& estimator,
                                     const typename Estimator::Model& model, double limit,
                                     double bound) {
  constexpr size_t kChunk = 128;  // Chosen: it fits the first-level cache.
  double errors[kChunk];
  const double squared_limit = limit * limit;
  double score = 0;
  size_t inliers = 0;
  for (size_t begin = 0; begin < estimator.size() && score <= bound; begin += kChunk) {
    const size_t end = std::min(estimator.size(), begin + kChunk);
    estimator.errors(model, begin, end, errors);
    for (size_t i = 0; i < end - begin; ++i) {
      const bool inlier = errors[i] < squared_limit;
      score += inlier ? errors[i] : squared_limit;
      inliers += inlier;
    }
  }
  return {score, inliers};
}

/// Number of iterations after which an outlier-free sample was drawn with the required confidence.
inline double needed_iterations(double inlier_ratio, size_t sample_size, double confidence) {
  const double good = std::pow(inlier_ratio, static_cast<double>(sample_size));
  if (good <= 1e-12) return std::numeric_limits<double>::infinity();
  if (good >= 1) return 1;
  return std::log(1 - confidence) / std::log(1 - good);
}

/// LO-RANSAC. The estimator provides `Model`, `kSampleSize`, `size()`, `solve(sample, models)`,
/// `errors(model, begin, end, squared)` and `refine(model, limit)`. Its data are sorted by quality;
/// the samples of the first quarter of the iterations come from a growing prefix (as in PROSAC).
template <class Estimator>
RansacResult<typename Estimator::Model> ransac(const Estimator& estimator,
                                               const RansacOptions& options,
                                               const ck_control* control) {
  using Model = typename Estimator::Model;
  constexpr size_t kSize = Estimator::kSampleSize;
  // Smallest length of the prefix. Chosen: enough for different samples.
  constexpr size_t kMinimumPool = 4 * kSize;
  // The prefix grows in one of this number of parts of the iterations. Chosen.
  constexpr int kParts = 4;
  constexpr int kReportInterval = 64;  // Chosen: far less than a second.
  RansacResult<Model> best;
  const size_t count = estimator.size();
  if (count < kSize) return best;
  Random random(options.seed);
  std::vector<Model> models;
  const int growing = std::max(1, options.maximum_iterations / kParts);
  double needed = options.maximum_iterations;
  for (int i = 0; i < options.maximum_iterations; ++i) {
    if (i >= options.minimum_iterations && i >= needed) break;
    if (i % kReportInterval == 0)
      step(control, static_cast<double>(i) / options.maximum_iterations);
    best.iterations = i + 1;
    const double grown = std::min(1.0, (i + 1.0) / growing);
    const size_t pool = std::min(
        count,
        std::max<size_t>(kMinimumPool, static_cast<size_t>(grown * static_cast<double>(count))));
    std::array<size_t, kSize> sample;
    for (size_t k = 0; k < kSize; ++k) {
      do {
        sample[k] = random.below(pool);
      } while (std::find(sample.begin(), sample.begin() + k, sample[k]) != sample.begin() + k);
    }
    estimator.solve(sample, models);
    bool improved = false;
    for (const Model& model : models) {
      const auto [score, inliers] = msac_score(estimator, model, options.maximum_error, best.score);
      if (!(score < best.score)) continue;
      best = {true, model, score, inliers, best.iterations};
      improved = true;
    }
    if (!improved) continue;
    Model refined = best.model;
    estimator.refine(refined, options.maximum_error);
    const auto [score, inliers] = msac_score(estimator, refined, options.maximum_error, best.score);
    if (score < best.score) best = {true, refined, score, inliers, best.iterations};
    needed = needed_iterations(static_cast<double>(best.inlier_count) / count, kSize,
                               options.confidence);
  }
  return best;
}

}  // namespace ck
