#include <open3d/geometry/KDTreeFlann.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "core/span.h"

namespace {

/// Queries per unit of work.
constexpr size_t kChunk = 4096;

/// The finite points and their indices in the input.
struct FinitePoints {
  Eigen::MatrixXd matrix;
  std::vector<int32_t> indices;

  explicit FinitePoints(const ck::Strided<float>& points) {
    for (size_t i = 0; i < points.count; ++i) {
      if (points.is_finite(i)) indices.push_back(static_cast<int32_t>(i));
    }
    matrix.resize(3, static_cast<Eigen::Index>(indices.size()));
    for (size_t k = 0; k < indices.size(); ++k) {
      const float* p = points[static_cast<size_t>(indices[k])];
      matrix.col(static_cast<Eigen::Index>(k)) << p[0], p[1], p[2];
    }
  }
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
    const size_t width = static_cast<size_t>(count), query_count = queries.count;
    std::fill(indices, indices + query_count * width, -1);
    std::fill(distances, distances + query_count * width, std::numeric_limits<float>::infinity());
    const FinitePoints finite(points);
    if (finite.indices.empty()) return;
    ck::step(control, 0);
    const open3d::geometry::KDTreeFlann tree(finite.matrix);
    const ck::Strided<float> q(queries);
    ck::parallel_for(control, (query_count + kChunk - 1) / kChunk, [&](size_t chunk) {
      std::vector<int> found;
      std::vector<double> squared;
      const size_t end = std::min(query_count, (chunk + 1) * kChunk);
      for (size_t i = chunk * kChunk; i < end; ++i) {
        if (!q.is_finite(i)) continue;
        const Eigen::Vector3d query(q[i][0], q[i][1], q[i][2]);
        const int n = std::isfinite(reach) ? tree.SearchHybrid(query, reach, count, found, squared)
                                           : tree.SearchKNN(query, count, found, squared);
        for (int k = 0; k < std::min(n, count); ++k) {
          indices[i * width + k] = finite.indices[found[k]];
          distances[i * width + k] = static_cast<float>(std::sqrt(squared[k]));
        }
      }
    });
  });
}
