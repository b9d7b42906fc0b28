#pragma once

#include <cstdint>
#include <vector>

#include "texture/cluster_graph.h"

namespace ck::texture {

/// Whether all normals of a cluster are at a larger cosine to an axis.
bool fits(const Cluster& cluster, Vec3 axis, float least_cosine);

/// Moves the clusters along the charts' borders where that makes these shorter.
class ChartBorders {
 public:
  /// `charts` has the chart of each cluster, `axes` that of each chart. `typical_length`: how wide
  /// a chart is, about.
  ChartBorders(const ClusterGraph& graph, const std::vector<Vec3>& axes, double typical_length,
               float maximum_angle, std::vector<uint32_t>* charts);

  void shorten();

 private:
  bool pass();
  uint32_t better_chart(uint32_t cluster);
  void list_charts_around(uint32_t cluster);
  bool cuts(uint32_t cluster);

  const ClusterGraph& graph_;
  const std::vector<Vec3>& axes_;
  const float typical_length_, least_cosine_;
  std::vector<uint32_t>& charts_;
  /// Used again and again: the other charts around a cluster and the length of its border with them
  /// and with its own, and the neighbours in its own.
  std::vector<Neighbor> around_;
  float inside_ = 0;
  std::vector<uint32_t> ring_;
};

}  // namespace ck::texture
