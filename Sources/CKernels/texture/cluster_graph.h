#pragma once

#include <cstdint>
#include <vector>

#include "texture/chart_mesh.h"

namespace ck::texture {

/// A connected set of triangles.
struct Cluster {
  Vec3 normal_sum;
  float area = 0;
  float perimeter = 0;
  /// Contains all normals.
  Cone cone;
  /// The projection direction.
  Vec3 axis;
};

/// An adjacent cluster.
struct Neighbor {
  uint32_t cluster;
  /// Length of the common boundary.
  float length;
};

/// Clusters and their adjacency.
struct ClusterGraph {
  struct Range {
    const Neighbor *first, *last;
    const Neighbor* begin() const { return first; }
    const Neighbor* end() const { return last; }
  };

  std::vector<Cluster> clusters;
  /// The neighbors of cluster i are those from starts[i] to starts[i + 1], in ascending order.
  std::vector<uint32_t> starts;
  std::vector<Neighbor> neighbors;
  /// The cluster of the contracted graph that contains each cluster.
  std::vector<uint32_t> parents;

  Range neighbors_of(uint32_t cluster) const {
    return {neighbors.data() + starts[cluster], neighbors.data() + starts[cluster + 1]};
  }

  /// The graph in which each cluster is merged into its target; a target has itself as target.
  /// Fills `parents`. With `keeps_axes` the axes of the targets are kept.
  ClusterGraph contracted(std::vector<uint32_t> targets, bool keeps_axes = false);
};

/// The graph with one cluster per triangle.
ClusterGraph graph_of(const ChartMesh& mesh);

/// The half-angle of the smallest cone around two cones.
float joined_angle(const Cone& a, const Cone& b);

}  // namespace ck::texture
