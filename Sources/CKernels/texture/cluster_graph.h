#pragma once

#include <cstdint>
#include <vector>

#include "texture/clusters.h"

namespace ck::texture {

/// Triangles that hang together.
struct Cluster {
  Vec3 normal_sum;
  float area = 0;
  float perimeter = 0;
  /// Holds all normals.
  Cone cone;
  /// The direction to project along.
  Vec3 axis;
};

struct Neighbor {
  uint32_t cluster;
  /// Of the common border.
  float length;
};

/// Clusters and which of them touch.
struct ClusterGraph {
  struct Range {
    const Neighbor *first, *last;
    const Neighbor* begin() const { return first; }
    const Neighbor* end() const { return last; }
  };

  std::vector<Cluster> clusters;
  /// The neighbours of cluster i are those from starts[i] to starts[i + 1], in ascending order.
  std::vector<uint32_t> starts;
  std::vector<Neighbor> neighbors;
  /// The cluster of the contracted graph that holds each.
  std::vector<uint32_t> parents;

  Range neighbors_of(uint32_t cluster) const {
    return {neighbors.data() + starts[cluster], neighbors.data() + starts[cluster + 1]};
  }

  /// The graph in which each cluster is one with the cluster that `targets` names, which names
  /// itself; fills `parents`. `keeps_axes`: those of the targets.
  ClusterGraph contracted(std::vector<uint32_t> targets, bool keeps_axes = false);
};

/// Each triangle a cluster.
ClusterGraph graph_of(const ChartMesh& mesh);

/// The angle of the smallest cone around two cones.
float joined_angle(const Cone& a, const Cone& b);

}  // namespace ck::texture
