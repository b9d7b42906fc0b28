#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "core/span.h"

namespace {

/// Queries per unit of work.
constexpr size_t kChunk = 4096;

/// The finite points and their indices in the input, as nanoflann's trees read them.
class FinitePoints {
 public:
  explicit FinitePoints(const ck::Strided<float>& points) {
    for (size_t i = 0; i < points.count; ++i) {
      if (!points.is_finite(i)) continue;
      indices_.push_back(static_cast<int32_t>(i));
      positions_.push_back({points[i][0], points[i][1], points[i][2]});
    }
  }

  bool is_empty() const { return indices_.empty(); }
  int32_t index(uint32_t number) const { return indices_[number]; }

  size_t kdtree_get_point_count() const { return positions_.size(); }
  float kdtree_get_pt(uint32_t number, size_t axis) const { return positions_[number][axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

 private:
  std::vector<int32_t> indices_;
  std::vector<std::array<float, 3>> positions_;
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, FinitePoints, double>,
                                        FinitePoints, 3, uint32_t>;

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
    const size_t width = static_cast<size_t>(count), query_count = queries.count;
    std::fill(indices, indices + query_count * width, -1);
    std::fill(distances, distances + query_count * width, std::numeric_limits<float>::infinity());
    const FinitePoints finite(points);
    if (finite.is_empty()) return;
    ck::step(control, 0);
    Tree tree(3, finite);
    tree.buildIndex();
    const ck::Strided<float> q(queries);
    ck::parallel_for(control, (query_count + kChunk - 1) / kChunk, [&](size_t chunk) {
      std::vector<uint32_t> found(width);
      std::vector<double> squared(width);
      const size_t end = std::min(query_count, (chunk + 1) * kChunk);
      for (size_t i = chunk * kChunk; i < end; ++i) {
        if (!q.is_finite(i)) continue;
        nanoflann::KNNResultSet<double, uint32_t> nearest(width);
        nearest.init(found.data(), squared.data());
        // Until that many are found, the last one's distance is the limit, which is included.
        squared.back() = std::nextafter(reach * reach, std::numeric_limits<double>::infinity());
        tree.findNeighbors(nearest, q[i], nanoflann::SearchParams());
        for (size_t k = 0; k < nearest.size(); ++k) {
          indices[i * width + k] = finite.index(found[k]);
          distances[i * width + k] = static_cast<float>(std::sqrt(squared[k]));
        }
      }
    });
  });
}
