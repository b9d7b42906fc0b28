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

ClusterGraph ClusterGraph::contracted(std::vector<uint32_t> targets, bool keeps_axes) {
  const auto count = static_cast<uint32_t>(clusters.size());
  parents = std::move(targets);
  ClusterGraph result;
  // Targets keep their order; `members` lists the clusters merged into each, the target first.
  std::vector<uint32_t> ids(count), member_starts(1, 0);
  for (uint32_t i = 0; i < count; ++i) {
    if (parents[i] == i) ids[i] = static_cast<uint32_t>(result.clusters.size());
    if (parents[i] == i) result.clusters.push_back(clusters[i]);
  }
  const size_t kept = result.clusters.size();
  member_starts.assign(kept + 1, 0);
  for (uint32_t i = 0; i < count; ++i) ++member_starts[ids[parents[i]] + 1];
  for (size_t k = 0; k < kept; ++k) member_starts[k + 1] += member_starts[k];
  std::vector<uint32_t> members(count), next(member_starts.begin(), member_starts.end() - 1);
  for (uint32_t i = 0; i < count; ++i) {
    if (parents[i] == i) members[next[ids[i]]++] = i;
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (parents[i] != i) members[next[ids[parents[i]]]++] = i;
  }
  for (uint32_t i = 0; i < count; ++i) parents[i] = ids[parents[i]];

  result.starts.assign(1, 0);
  result.starts.reserve(kept + 1);
  result.neighbors.reserve(neighbors.size() / 2);
  std::vector<Neighbor> list;
  for (uint32_t k = 0; k < kept; ++k) {
    Cluster& cluster = result.clusters[k];
    list.clear();
    float inner = 0;
    for (uint32_t m = member_starts[k]; m < member_starts[k + 1]; ++m) {
      const Cluster& member = clusters[members[m]];
      if (m > member_starts[k]) {
        cluster.normal_sum += member.normal_sum;
        cluster.area += member.area;
        cluster.perimeter += member.perimeter;
        cluster.cone = joined(cluster.cone, member.cone);
        if (!keeps_axes) cluster.axis = cluster.cone.axis;
      }
      for (const Neighbor& n : neighbors_of(members[m])) {
        const uint32_t id = parents[n.cluster];
        if (id == k) {
          inner += n.length;
        } else {
          list.push_back({id, n.length});
        }
      }
    }
    // Each inner boundary was counted from both sides.
    cluster.perimeter = std::max(0.0f, cluster.perimeter - inner);
    std::sort(list.begin(), list.end(), [](const Neighbor& a, const Neighbor& b) {
      return a.cluster != b.cluster ? a.cluster < b.cluster : a.length < b.length;
    });
    const size_t start = result.neighbors.size();
    for (const Neighbor& n : list) {
      if (result.neighbors.size() > start && result.neighbors.back().cluster == n.cluster) {
        result.neighbors.back().length += n.length;
      } else {
        result.neighbors.push_back(n);
      }
    }
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
