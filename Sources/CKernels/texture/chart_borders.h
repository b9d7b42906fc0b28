#pragma once

#include <cstdint>
#include <vector>

#include "texture/cluster_graph.h"

namespace ck::texture {

/// Whether all normals of a cluster have a larger cosine to an axis.
bool fits(const Cluster& cluster, Vec3 axis, float minimum_cosine);

/// Moves clusters along chart boundaries to neighboring charts where that shortens the boundaries.
class ChartBorders {
 public:
  /// `charts` holds the chart of each cluster, `axes` the axis of each chart; `typical_length` is
  /// the typical width of a chart.
  ChartBorders(const ClusterGraph& graph, const std::vector<Vec3>& axes, double typical_length,
               float maximum_angle, std::vector<uint32_t>* charts);

  /// Runs rounds until nothing moves.
  void shorten();

 private:
  bool pass();
  uint32_t better_chart(uint32_t cluster);
  void list_charts_around(uint32_t cluster);
  bool disconnects(uint32_t cluster);

  const ClusterGraph& graph_;
  const std::vector<Vec3>& axes_;
  const float typical_length_, minimum_cosine_;
  std::vector<uint32_t>& charts_;
  /// Reused buffers: the other charts around a cluster with the lengths of the common boundaries,
  /// the length of its boundary within the current chart, and its neighbors in the current chart.
  std::vector<Neighbor> around_;
  float inside_ = 0;
  std::vector<uint32_t> ring_;
};

}  // namespace ck::texture
