#include "texture/cluster_graph.h"

#include <algorithm>
#include <cmath>

namespace ck::texture {

ClusterGraph graph_of(const ChartMesh& mesh) {
  const size_t count = mesh.triangles.size();
  ClusterGraph graph;
  graph.clusters.resize(count);
  for (size_t t = 0; t < count; ++t) {
    Cluster& c = graph.clusters[t];
    c.normal_sum = mesh.normals[t] * mesh.areas[t];
    c.area = mesh.areas[t];
    c.perimeter = mesh.perimeters[t];
    c.cone = {mesh.normals[t], 0};
    c.axis = mesh.normals[t];
  }
  // As `edges` are sorted, the neighbors of each triangle are in ascending order; several common
  // edges of two triangles are merged on contraction.
  graph.starts.assign(count + 1, 0);
  for (const DualEdge& e : mesh.edges) {
    ++graph.starts[e.a + 1];
    ++graph.starts[e.b + 1];
  }
  for (size_t i = 0; i < count; ++i) graph.starts[i + 1] += graph.starts[i];
  graph.neighbors.resize(2 * mesh.edges.size());
  std::vector<uint32_t> next(graph.starts.begin(), graph.starts.end() - 1);
  for (const DualEdge& e : mesh.edges) {
    graph.neighbors[next[e.a]++] = {e.b, e.length};
    graph.neighbors[next[e.b]++] = {e.a, e.length};
  }
  return graph;
}

namespace {

/// The clusters merged into each cluster of a contracted graph: `list[starts[k]..<starts[k + 1]]`,
/// the target first.
struct Members {
  std::vector<uint32_t> starts, list;

  /// `targets` holds the merge target of each cluster, `ids` the index of each target in the
  /// contracted graph.
  Members(const std::vector<uint32_t>& targets, const std::vector<uint32_t>& ids, size_t kept)
      : starts(kept + 1, 0), list(targets.size()) {
    const auto count = static_cast<uint32_t>(targets.size());
    for (uint32_t i = 0; i < count; ++i) ++starts[ids[targets[i]] + 1];
    for (size_t k = 0; k < kept; ++k) starts[k + 1] += starts[k];
    std::vector<uint32_t> next(starts.begin(), starts.end() - 1);
    for (uint32_t i = 0; i < count; ++i) {
      if (targets[i] == i) list[next[ids[i]]++] = i;
    }
    for (uint32_t i = 0; i < count; ++i) {
      if (targets[i] != i) list[next[ids[targets[i]]]++] = i;
    }
  }
};

/// Adds a member's triangles to a cluster.
void absorb(Cluster& cluster, const Cluster& member, bool keeps_axis) {
  cluster.normal_sum += member.normal_sum;
  cluster.area += member.area;
  cluster.perimeter += member.perimeter;
  cluster.cone = joined(cluster.cone, member.cone);
  if (!keeps_axis) cluster.axis = cluster.cone.axis;
}

/// Appends neighbors in ascending order, those of one cluster with the sum of their lengths.
void append(std::vector<Neighbor>& all, std::vector<Neighbor>& added) {
  std::sort(added.begin(), added.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.cluster != b.cluster ? a.cluster < b.cluster : a.length < b.length;
  });
  const size_t start = all.size();
  for (const Neighbor& n : added) {
    if (all.size() > start && all.back().cluster == n.cluster) {
      all.back().length += n.length;
    } else {
      all.push_back(n);
    }
  }
}

}  // namespace

ClusterGraph ClusterGraph::contracted(std::vector<uint32_t> targets, bool keeps_axes) {
  const auto count = static_cast<uint32_t>(clusters.size());
  ClusterGraph result;
  // Targets keep their order.
  std::vector<uint32_t> ids(count);
  for (uint32_t i = 0; i < count; ++i) {
    if (targets[i] != i) continue;
    ids[i] = static_cast<uint32_t>(result.clusters.size());
    result.clusters.push_back(clusters[i]);
  }
  const size_t kept = result.clusters.size();
  const Members members(targets, ids, kept);
  parents = std::move(targets);
  for (uint32_t i = 0; i < count; ++i) parents[i] = ids[parents[i]];

  result.starts.assign(1, 0);
  result.starts.reserve(kept + 1);
  result.neighbors.reserve(neighbors.size() / 2);
  std::vector<Neighbor> around;
  for (uint32_t k = 0; k < kept; ++k) {
    Cluster& cluster = result.clusters[k];
    around.clear();
    float inner = 0;
    for (uint32_t m = members.starts[k]; m < members.starts[k + 1]; ++m) {
      const uint32_t member = members.list[m];
      if (m > members.starts[k]) absorb(cluster, clusters[member], keeps_axes);
      for (const Neighbor& n : neighbors_of(member)) {
        const uint32_t id = parents[n.cluster];
        if (id == k) {
          inner += n.length;
        } else {
          around.push_back({id, n.length});
        }
      }
    }
    // Each inner boundary was counted from both sides.
    cluster.perimeter = std::max(0.0f, cluster.perimeter - inner);
    append(result.neighbors, around);
    result.starts.push_back(static_cast<uint32_t>(result.neighbors.size()));
  }
  return result;
}

float joined_angle(const Cone& a, const Cone& b) {
  if (dot(a.axis, a.axis) == 0) return b.angle;
  if (dot(b.axis, b.axis) == 0) return a.angle;
  const float between = std::acos(std::clamp(dot(a.axis, b.axis), -1.0f, 1.0f));
  return std::max({a.angle, b.angle, (between + a.angle + b.angle) / 2});
}

}  // namespace ck::texture
