#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <nanoflann.hpp>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "core/span.h"

namespace {

/// Queries per unit of work. Chosen.
constexpr size_t kChunk = 4096;
/// Points of a tree, and the number of trees from which on they get more. Chosen: many threads
/// build trees, and a search hardly has to look at more than one.
constexpr size_t kTreePoints = 1 << 15, kMostTrees = 32;

struct Point {
  std::array<float, 3> position;
  /// In the input.
  int32_t index;
};

/// The nearest points found so far, the nearest first.
class Nearest {
 public:
  /// Points at a squared distance of `limit` or more are ignored.
  Nearest(size_t count, double limit) : limit_(limit), squared_(count), indices_(count) {
    squared_.back() = limit;
  }

  /// Starts a new search.
  void clear() {
    found_ = 0;
    squared_.back() = limit_;
  }
  /// Sets the points that the numbers of `addPoint` refer to.
  void look_in(const Point* points) { points_ = points; }
  double squared(size_t k) const { return squared_[k]; }
  int32_t index(size_t k) const { return indices_[k]; }
  size_t size() const { return found_; }

  // What nanoflann calls.
  using DistanceType = double;
  bool full() const { return found_ == squared_.size(); }
  double worstDist() const { return squared_.back(); }
  bool addPoint(double squared, uint32_t number) {
    // nanoflann compares with the distance that was the worst some points ago.
    if (squared >= worstDist()) return true;
    size_t k = full() ? found_ - 1 : found_++;
    for (; k > 0 && squared < squared_[k - 1]; --k) {
      squared_[k] = squared_[k - 1];
      indices_[k] = indices_[k - 1];
    }
    squared_[k] = squared;
    indices_[k] = points_[number].index;
    return true;
  }

 private:
  double limit_;
  std::vector<double> squared_;
  std::vector<int32_t> indices_;
  const Point* points_ = nullptr;
  size_t found_ = 0;
};

/// A part of the points with a tree, which nanoflann builds on one thread.
class PartTree {
 public:
  PartTree(const Point* points, size_t count) : points_(points), count_(count), tree_(3, *this) {
    tree_.buildIndex();
    low_ = high_ = points[0].position;
    for (size_t i = 1; i < count; ++i) {
      for (size_t a = 0; a < 3; ++a) {
        low_[a] = std::min(low_[a], points[i].position[a]);
        high_[a] = std::max(high_[a], points[i].position[a]);
      }
    }
  }
  PartTree(const PartTree&) = delete;
  PartTree& operator=(const PartTree&) = delete;

  /// The squared distance of a position from the box around the points.
  double squared_distance(const float* p) const {
    double sum = 0;
    for (size_t a = 0; a < 3; ++a) {
      const double outside = std::max({0.0, double(low_[a]) - p[a], double(p[a]) - high_[a]});
      sum += outside * outside;
    }
    return sum;
  }

  template <typename Results>
  void search(const float* position, Results& results) const {
    results.look_in(points_);
    tree_.findNeighbors(results, position, nanoflann::SearchParams());
  }

  // What nanoflann calls.
  size_t kdtree_get_point_count() const { return count_; }
  float kdtree_get_pt(uint32_t number, size_t axis) const { return points_[number].position[axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

 private:
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PartTree, double>,
                                          PartTree, 3, uint32_t>;

  const Point* points_;
  size_t count_;
  Tree tree_;
  std::array<float, 3> low_, high_;
};

/// The finite points in parts of about the same size, each with a tree, built in parallel.
class Forest {
 public:
  Forest(const ck::Strided<float>& points, const ck_control* control) {
    for (size_t i = 0; i < points.count; ++i) {
      if (!points.is_finite(i)) continue;
      points_.push_back({{points[i][0], points[i][1], points[i][2]}, static_cast<int32_t>(i)});
    }
    if (points_.empty()) return;
    const ck_control quiet{nullptr, nullptr, ck::thread_count(control)};
    std::vector<size_t> starts{0, points_.size()};
    while (points_.size() / (starts.size() - 1) > kTreePoints && starts.size() <= kMostTrees) {
      starts = halved(starts, &quiet);
    }
    trees_.resize(starts.size() - 1);
    ck::parallel_for(&quiet, trees_.size(), [&](size_t i) {
      trees_[i] = std::make_unique<PartTree>(points_.data() + starts[i], starts[i + 1] - starts[i]);
    });
  }

  /// The finite points, those of a part one behind the other.
  const std::vector<Point>& points() const { return points_; }

  /// Continues a search in all parts that may have points for it.
  template <typename Results>
  void search(const float* position, Results& results) const {
    if (trees_.empty()) return;
    size_t first = 0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < trees_.size() && least > 0; ++i) {
      const double squared = trees_[i]->squared_distance(position);
      if (squared < least) first = i;
      least = std::min(least, squared);
    }
    trees_[first]->search(position, results);
    for (size_t i = 0; i < trees_.size(); ++i) {
      if (i == first || !(trees_[i]->squared_distance(position) < results.worstDist())) continue;
      trees_[i]->search(position, results);
    }
  }

 private:
  /// Halves every part across the longest side of its box.
  std::vector<size_t> halved(const std::vector<size_t>& starts, const ck_control* control) {
    std::vector<size_t> result(2 * starts.size() - 1, points_.size());
    ck::parallel_for(control, starts.size() - 1, [&](size_t i) {
      result[2 * i] = starts[i];
      result[2 * i + 1] = (starts[i] + starts[i + 1]) / 2;
      halve(starts[i], result[2 * i + 1], starts[i + 1]);
    });
    return result;
  }

  void halve(size_t begin, size_t middle, size_t end) {
    std::array<float, 3> low = points_[begin].position, high = low;
    for (size_t i = begin; i < end; ++i) {
      for (size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], points_[i].position[a]);
        high[a] = std::max(high[a], points_[i].position[a]);
      }
    }
    size_t axis = 0;
    for (size_t a = 1; a < 3; ++a) {
      if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
    }
    const auto at = [&](size_t i) { return points_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(begin), at(middle), at(end), [axis](const Point& a, const Point& b) {
      return a.position[axis] < b.position[axis];
    });
  }

  std::vector<Point> points_;
  std::vector<std::unique_ptr<PartTree>> trees_;
};

}  // namespace

ck_status ck_nearest_points(ck_span points, ck_span queries, const ck_nearest_options* options,
                            const ck_control* control, int32_t* indices, float* distances) {
  return ck::guarded([&] {
    ck::require((points.data || points.count == 0) && (queries.data || queries.count == 0),
                "null pointer");
    const int count = options->neighbors;
    const double reach = options->maximum_distance;
    ck::require(count > 0 && indices && distances, "invalid output");
    ck::require(reach > 0, "the distance must be positive");
    const auto width = static_cast<size_t>(count);
    const size_t query_count = queries.count;
    std::fill(indices, indices + query_count * width, -1);
    std::fill(distances, distances + query_count * width, std::numeric_limits<float>::infinity());
    ck::step(control, 0);
    const Forest forest(points, control);
    const ck::Strided<float> q(queries);
    ck::parallel_for(control, (query_count + kChunk - 1) / kChunk, [&](size_t chunk) {
      // The largest distance is included.
      Nearest nearest(width,
                      std::nextafter(reach * reach, std::numeric_limits<double>::infinity()));
      const size_t end = std::min(query_count, (chunk + 1) * kChunk);
      for (size_t i = chunk * kChunk; i < end; ++i) {
        if (!q.is_finite(i)) continue;
        nearest.clear();
        forest.search(q[i], nearest);
        for (size_t k = 0; k < nearest.size(); ++k) {
          indices[i * width + k] = nearest.index(k);
          distances[i * width + k] = static_cast<float>(std::sqrt(nearest.squared(k)));
        }
      }
    });
  });
}
