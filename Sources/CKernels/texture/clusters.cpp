#include "texture/chart_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "ck_texture.h"
#include "core/guard.h"
#include "core/random.h"
#include "texture/chart_borders.h"
#include "texture/cluster_graph.h"

namespace ck::texture {
namespace {

/// Cost of a cluster per area that does not depend on its flatness, so that small clusters merge
/// first. Chosen.
constexpr float kPlainCost = 0.02f;
/// Limit: 4π, the ratio of the squared perimeter of a disk to its area.
constexpr float kDiskIrregularity = 12.566f;

/// Hash of two numbers: the tie-breaking order of pairs with equal cost.
uint64_t scrambled(uint32_t a, uint32_t b) {
  return Random(static_cast<uint64_t>(a) << 32 | b).next();
}

/// Merges clusters in rounds: in each round all pairs that are each other's cheapest neighbor.
class Clustering {
 public:
  Clustering(const ChartMesh& mesh, const ck_chart_options& options)
      : mesh_(mesh), options_(options) {
    levels_.push_back(graph_of(mesh));
    for (const Cluster& c : levels_[0].clusters) total_area_ += c.area;
  }

  void run(const ck_control* control) {
    for (size_t round = 0; merge_cheapest(); ++round) {
      step(control, 0.8 * (1 - 1 / static_cast<double>(round + 2)));
    }
    while (absorb_small()) step(control, 0.8);
    refine(control);
    absorb_remains();
    center_axes();
  }

  void copy(std::vector<int32_t>* charts, std::vector<Vec3>* axes) const {
    charts->assign(charts_.begin(), charts_.end());
    *axes = axes_;
  }

 private:
  /// The cost of merging two clusters; negative if it is not permitted.
  float cost(const Cluster& a, const Cluster& b, float shared) const {
    if (joined_angle(a.cone, b.cone) > options_.maximum_angle) return -1;
    const float area = a.area + b.area;
    if (!(area > 0)) return 0;
    // Spread of the normals times irregularity of the outline (1 for a disk, Garland et al.), with
    // small clusters first.
    const float spread = std::max(0.0f, 1 - length(a.normal_sum + b.normal_sum) / area);
    const float perimeter = std::max(0.0f, a.perimeter + b.perimeter - 2 * shared);
    const float irregularity = perimeter * perimeter / (kDiskIrregularity * area);
    return area * (spread + kPlainCost) * irregularity;
  }

  bool merge_cheapest() {
    const ClusterGraph& graph = levels_.back();
    const size_t count = graph.clusters.size();
    std::vector<uint32_t> best(count);
    std::vector<float> costs(count, 0);
    for (uint32_t i = 0; i < count; ++i) {
      best[i] = i;
      float& lowest = costs[i];
      uint64_t order = 0;
      for (const Neighbor& n : graph.neighbors_of(i)) {
        const uint32_t a = std::min(i, n.cluster), b = std::max(i, n.cluster);
        const float value = cost(graph.clusters[a], graph.clusters[b], n.length);
        if (value < 0 || (best[i] != i && value > lowest)) continue;
        const uint64_t rank = scrambled(a, b);
        if (best[i] != i && value == lowest && rank > order) continue;
        best[i] = n.cluster;
        lowest = value;
        order = rank;
      }
    }
    std::vector<uint32_t> parents = paired(best, costs);
    bool has_merged = false;
    for (uint32_t i = 0; i < count; ++i) has_merged = has_merged || parents[i] != i;
    if (has_merged) levels_.push_back(levels_.back().contracted(std::move(parents)));
    return has_merged;
  }

  /// The merge target of each cluster: of two that are each other's cheapest, the first.
  static std::vector<uint32_t> paired(const std::vector<uint32_t>& best,
                                      const std::vector<float>& costs) {
    std::vector<uint32_t> parents(best.size());
    std::iota(parents.begin(), parents.end(), 0u);
    std::vector<uint32_t> waiting;
    size_t pairs = 0;
    for (uint32_t i = 0; i < best.size(); ++i) {
      if (best[i] == i) continue;
      if (best[best[i]] != i) {
        waiting.push_back(i);
      } else if (i < best[i]) {
        parents[best[i]] = i;
        ++pairs;
      }
    }
    if (pairs * kClustersPerPair >= waiting.size()) return parents;
    // Along a gradient of costs hardly any two are each other's cheapest; there the cheapest merge
    // first.
    std::sort(waiting.begin(), waiting.end(), [&](uint32_t a, uint32_t b) {
      return costs[a] != costs[b] ? costs[a] < costs[b] : a < b;
    });
    std::vector<bool> is_taken(best.size(), false);
    for (uint32_t i = 0; i < best.size(); ++i) {
      is_taken[i] = best[i] != i && best[best[i]] == i;
    }
    for (const uint32_t i : waiting) {
      if (is_taken[i] || is_taken[best[i]]) continue;
      is_taken[i] = is_taken[best[i]] = true;
      parents[std::max(i, best[i])] = std::min(i, best[i]);
    }
    return parents;
  }

  /// Merges small clusters with the neighbor with the longest common boundary that this does not
  /// fold.
  bool absorb_small() {
    const ClusterGraph& graph = levels_.back();
    const size_t count = graph.clusters.size();
    const double limit = options_.minimum_share * total_area_;
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < count; ++i) {
      if (graph.clusters[i].area < limit) order.push_back(i);
    }
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      const float sa = graph.clusters[a].area, sb = graph.clusters[b].area;
      return sa != sb ? sa < sb : a < b;
    });
    std::vector<uint32_t> parents(count);
    std::iota(parents.begin(), parents.end(), 0u);
    std::vector<bool> is_target(count, false);
    bool has_merged = false;
    for (const uint32_t i : order) {
      if (is_target[i]) continue;
      uint32_t best = i;
      float longest = 0;
      for (const Neighbor& n : graph.neighbors_of(i)) {
        const bool is_free = parents[n.cluster] == n.cluster;
        if (!is_free || !(n.length > longest)) continue;
        if (!may_join(i, graph.clusters[n.cluster].axis)) continue;
        best = n.cluster;
        longest = n.length;
      }
      if (best == i) continue;
      parents[i] = best;
      is_target[best] = true;
      has_merged = true;
    }
    if (!has_merged) return false;
    levels_.push_back(levels_.back().contracted(std::move(parents), true));
    return true;
  }

  /// Merges charts that the refinement left small, with a test of each of their triangles.
  void absorb_remains() {
    std::vector<uint32_t> first(axes_.size(), UINT32_MAX), targets(charts_.size());
    for (uint32_t t = 0; t < charts_.size(); ++t) {
      if (first[charts_[t]] == UINT32_MAX) first[charts_[t]] = t;
      targets[t] = first[charts_[t]];
    }
    levels_.push_back(levels_[0].contracted(std::move(targets)));
    std::vector<Vec3> axes(levels_[1].clusters.size());
    for (uint32_t t = 0; t < charts_.size(); ++t) {
      axes[levels_[0].parents[t]] = axes_[charts_[t]];
    }
    for (size_t i = 0; i < axes.size(); ++i) levels_[1].clusters[i].axis = axes[i];
    charts_ = levels_[0].parents;
    is_exact_ = true;
    for (list_faces(); absorb_small(); list_faces()) {
      const std::vector<uint32_t>& parents = levels_[levels_.size() - 2].parents;
      for (uint32_t& chart : charts_) chart = parents[chart];
    }
    axes_.clear();
    for (const Cluster& c : levels_.back().clusters) axes_.push_back(c.axis);
  }

  /// Groups the triangles by chart.
  void list_faces() {
    starts_.assign(levels_.back().clusters.size() + 1, 0);
    for (const uint32_t chart : charts_) ++starts_[chart + 1];
    for (size_t i = 0; i + 1 < starts_.size(); ++i) starts_[i + 1] += starts_[i];
    std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
    faces_.resize(charts_.size());
    for (uint32_t t = 0; t < charts_.size(); ++t) faces_[next[charts_[t]]++] = t;
  }

  /// Projects charts along their mean normal where all triangles face it as well.
  void center_axes() {
    std::vector<Vec3> sums(axes_.size());
    std::vector<float> least(axes_.size(), 1), least_before(axes_.size(), 1);
    for (size_t t = 0; t < charts_.size(); ++t)
      sums[charts_[t]] += mesh_.normals[t] * mesh_.areas[t];
    for (Vec3& sum : sums) sum = normalized(sum);
    for (size_t t = 0; t < charts_.size(); ++t) {
      if (!(mesh_.areas[t] > 0)) continue;
      const uint32_t chart = charts_[t];
      least[chart] = std::min(least[chart], dot(mesh_.normals[t], sums[chart]));
      least_before[chart] = std::min(least_before[chart], dot(mesh_.normals[t], axes_[chart]));
    }
    const float enough = std::cos(options_.maximum_angle);
    for (size_t i = 0; i < axes_.size(); ++i) {
      if (least[i] >= std::min(enough, least_before[i])) axes_[i] = sums[i];
    }
  }

  /// Multilevel refinement of the chart boundaries, from large clusters to single triangles (after
  /// Karypis and Kumar, SIAM J. Sci. Comput. 1998).
  void refine(const ck_control* control) {
    axes_.clear();
    for (const Cluster& c : levels_.back().clusters) {
      axes_.push_back(dot(c.axis, c.axis) > 0.5f ? c.axis : Vec3{0, 0, 1});
    }
    charts_.resize(axes_.size());
    std::iota(charts_.begin(), charts_.end(), 0u);
    const double typical =
        std::sqrt(total_area_ / static_cast<double>(std::max<size_t>(1, axes_.size())));
    while (levels_.size() > 1) {
      levels_.pop_back();
      const ClusterGraph& graph = levels_.back();
      std::vector<uint32_t> finer(graph.clusters.size());
      for (size_t i = 0; i < finer.size(); ++i) finer[i] = charts_[graph.parents[i]];
      charts_ = std::move(finer);
      step(control, 0.9);
      ChartBorders(graph, axes_, typical, options_.maximum_angle, &charts_).shorten();
    }
  }

  /// Whether all of a small cluster faces an axis well enough to be merged into its chart.
  bool may_join(uint32_t cluster, Vec3 axis) const {
    if (!is_exact_) return fits(levels_.back().clusters[cluster], axis, kAbsorbedCosine);
    return std::all_of(
        faces_.begin() + starts_[cluster], faces_.begin() + starts_[cluster + 1], [&](uint32_t t) {
          return !(mesh_.areas[t] > 0) || dot(mesh_.normals[t], axis) > kAbsorbedCosine;
        });
  }

  /// Smallest cosine between the axis of a chart and the normals of the triangles merged into it.
  /// Chosen.
  static constexpr float kAbsorbedCosine = 0.4f;
  /// If there are fewer pairs than one per this number of unpaired clusters, more pairs are formed.
  /// Chosen.
  static constexpr size_t kClustersPerPair = 16;

  const ChartMesh& mesh_;
  const ck_chart_options& options_;
  double total_area_ = 0;
  std::vector<ClusterGraph> levels_;
  /// The chart of each cluster of the last level, and the projection directions of the charts.
  std::vector<uint32_t> charts_;
  std::vector<Vec3> axes_;
  /// Whether small clusters are tested triangle by triangle.
  bool is_exact_ = false;
  /// The triangles of each chart: `faces_` from starts_[i] to starts_[i + 1].
  std::vector<uint32_t> starts_, faces_;
};

}  // namespace
}  // namespace ck::texture

ck_status ck_cluster_faces(const ck_mesh* input, const ck_chart_options* options,
                           const ck_control* control, int32_t* charts, float* axes,
                           size_t* chart_count) {
  return ck::guarded([&] {
    ck::require(input && options && charts && axes && chart_count, "an argument is missing");
    ck::step(control, 0);
    const ck::texture::ChartMesh mesh(*input);
    std::vector<int32_t> chart_of_face;
    std::vector<ck::Vec3> directions;
    {
      ck::texture::Clustering clustering(mesh, *options);
      clustering.run(control);
      clustering.copy(&chart_of_face, &directions);
    }
    ck::step(control, 0.95);
    ck::texture::separate_overlaps(mesh, &chart_of_face, &directions);
    std::copy(chart_of_face.begin(), chart_of_face.end(), charts);
    for (size_t i = 0; i < directions.size(); ++i) {
      axes[3 * i] = directions[i].x;
      axes[3 * i + 1] = directions[i].y;
      axes[3 * i + 2] = directions[i].z;
    }
    *chart_count = directions.size();
  });
}
