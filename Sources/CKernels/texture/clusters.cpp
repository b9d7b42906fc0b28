#include "texture/clusters.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "ck_texture.h"
#include "core/guard.h"

namespace ck::texture {
namespace {

struct Neighbor {
  int32_t cluster;
  float length;
};

struct Cluster {
  Vec3 normal_sum;
  float area = 0;
  float perimeter = 0;
  Cone cone;
  uint32_t version = 0;
  bool alive = true;
  std::vector<int32_t> faces;
  /// Sorted by cluster.
  std::vector<Neighbor> neighbors;
};

struct Candidate {
  float cost;
  int32_t a, b;
  uint32_t version_a, version_b;
  bool operator<(const Candidate& o) const {
    if (cost != o.cost) return cost > o.cost;
    return a != o.a ? a > o.a : b > o.b;
  }
};

class Clustering {
 public:
  Clustering(const ChartMesh& mesh, const ck_chart_options& options)
      : mesh_(mesh), options_(options), clusters_(mesh.triangles.size()) {
    for (size_t t = 0; t < clusters_.size(); ++t) {
      Cluster& c = clusters_[t];
      c.normal_sum = mesh.normals[t] * mesh.areas[t];
      c.area = mesh.areas[t];
      c.perimeter = mesh.perimeters[t];
      c.cone = {mesh.normals[t], 0};
      c.faces = {static_cast<int32_t>(t)};
    }
    for (const DualEdge& e : mesh.edges) {
      add_neighbor(static_cast<int32_t>(e.a), static_cast<int32_t>(e.b), e.length);
      add_neighbor(static_cast<int32_t>(e.b), static_cast<int32_t>(e.a), e.length);
    }
    for (const DualEdge& e : mesh.edges) {
      push(static_cast<int32_t>(e.a), static_cast<int32_t>(e.b), e.length);
    }
  }

  void merge(const ck_control* control) {
    size_t merges = 0;
    while (!queue_.empty()) {
      const Candidate c = queue_.top();
      queue_.pop();
      if (clusters_[static_cast<size_t>(c.a)].version != c.version_a ||
          clusters_[static_cast<size_t>(c.b)].version != c.version_b) {
        continue;
      }
      if (++merges % 4096 == 0) {
        step(control, 0.9 * static_cast<double>(merges) / static_cast<double>(clusters_.size()));
      }
      const int32_t kept = join(c.a, c.b);
      const Cluster& cluster = at(kept);
      for (const Neighbor& n : cluster.neighbors) push(kept, n.cluster, n.length);
    }
  }

  /// Joins small clusters to the neighbour with the longest border that they don't fold.
  void absorb_small() {
    std::vector<int32_t> order;
    for (size_t i = 0; i < clusters_.size(); ++i) {
      if (clusters_[i].alive && is_small(clusters_[i])) order.push_back(static_cast<int32_t>(i));
    }
    std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
      const size_t sa = at(a).faces.size(), sb = at(b).faces.size();
      return sa != sb ? sa < sb : a < b;
    });
    for (const int32_t i : order) {
      if (!at(i).alive || !is_small(at(i))) continue;
      int32_t best = -1;
      float longest = 0;
      for (const Neighbor& n : at(i).neighbors) {
        if (n.length > longest && fits(at(i), at(n.cluster))) {
          best = n.cluster;
          longest = n.length;
        }
      }
      if (best < 0) continue;
      const Cone cone = at(best).cone;
      at(join(i, best)).cone = cone;
    }
  }

  void copy(std::vector<int32_t>* charts, std::vector<Vec3>* axes) const {
    charts->assign(mesh_.triangles.size(), 0);
    for (size_t first = 0; first < clusters_.size(); ++first) {
      const Cluster& c = clusters_[first];
      if (!c.alive) continue;
      for (const int32_t f : c.faces) {
        (*charts)[static_cast<size_t>(f)] = static_cast<int32_t>(axes->size());
      }
      const bool has_axis = dot(c.cone.axis, c.cone.axis) > 0.5f;
      axes->push_back(has_axis ? c.cone.axis : Vec3{0, 0, 1});
    }
  }

 private:
  Cluster& at(int32_t i) { return clusters_[static_cast<size_t>(i)]; }
  const Cluster& at(int32_t i) const { return clusters_[static_cast<size_t>(i)]; }

  bool is_small(const Cluster& c) const {
    return c.faces.size() < static_cast<size_t>(options_.minimum_faces);
  }

  bool fits(const Cluster& small, const Cluster& other) const {
    return std::all_of(small.faces.begin(), small.faces.end(), [&](int32_t f) {
      const Vec3 n = mesh_.normals[static_cast<size_t>(f)];
      return dot(n, n) == 0 || dot(n, other.cone.axis) > 0.2f;
    });
  }

  void add_neighbor(int32_t cluster, int32_t neighbor, float length) {
    auto& list = at(cluster).neighbors;
    const auto place =
        std::lower_bound(list.begin(), list.end(), neighbor,
                         [](const Neighbor& n, int32_t value) { return n.cluster < value; });
    if (place != list.end() && place->cluster == neighbor) {
      place->length += length;
    } else {
      list.insert(place, {neighbor, length});
    }
  }

  void push(int32_t first, int32_t second, float shared) {
    const int32_t a = std::min(first, second), b = std::max(first, second);
    const Cluster &ca = at(a), &cb = at(b);
    if (joined(ca.cone, cb.cone).angle > options_.maximum_angle) return;
    const float area = ca.area + cb.area;
    if (!(area > 0)) {
      queue_.push({0, a, b, ca.version, cb.version});
      return;
    }
    // How uneven the normals are, how ragged the outline; small ones first.
    const float unevenness = 1 - length(ca.normal_sum + cb.normal_sum) / area;
    const float perimeter = std::max(0.0f, ca.perimeter + cb.perimeter - 2 * shared);
    const float raggedness = perimeter * perimeter / (12.566f * area);
    queue_.push({area * (unevenness + 0.02f) * raggedness, a, b, ca.version, cb.version});
  }

  /// Merges one cluster into the other and returns the one that stays.
  int32_t join(int32_t a, int32_t b) {
    if (at(a).neighbors.size() < at(b).neighbors.size()) std::swap(a, b);
    Cluster &kept = at(a), &gone = at(b);
    float shared = 0;
    for (const Neighbor& n : gone.neighbors) {
      if (n.cluster == a) {
        shared = n.length;
        continue;
      }
      remove_neighbor(n.cluster, b);
      add_neighbor(n.cluster, a, n.length);
      add_neighbor(a, n.cluster, n.length);
    }
    remove_neighbor(a, b);
    kept.cone = joined(kept.cone, gone.cone);
    kept.normal_sum += gone.normal_sum;
    kept.area += gone.area;
    kept.perimeter = std::max(0.0f, kept.perimeter + gone.perimeter - 2 * shared);
    if (kept.faces.size() < gone.faces.size()) kept.faces.swap(gone.faces);
    kept.faces.insert(kept.faces.end(), gone.faces.begin(), gone.faces.end());
    ++kept.version;
    ++gone.version;
    gone.alive = false;
    gone.faces = {};
    gone.neighbors = {};
    return a;
  }

  void remove_neighbor(int32_t cluster, int32_t neighbor) {
    auto& list = at(cluster).neighbors;
    const auto place =
        std::lower_bound(list.begin(), list.end(), neighbor,
                         [](const Neighbor& n, int32_t value) { return n.cluster < value; });
    if (place != list.end() && place->cluster == neighbor) list.erase(place);
  }

  const ChartMesh& mesh_;
  const ck_chart_options& options_;
  std::vector<Cluster> clusters_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace
}  // namespace ck::texture

ck_status ck_cluster_faces(const float* positions, size_t position_count, size_t position_stride,
                           const uint32_t* triangles, size_t triangle_count,
                           const ck_chart_options* options, const ck_control* control,
                           int32_t* charts, float* axes, size_t* chart_count) {
  return ck::guarded([&] {
    ck::require(options && charts && axes && chart_count, "an argument is missing");
    ck::step(control, 0);
    const ck::texture::ChartMesh mesh(positions, position_count, position_stride, triangles,
                                      triangle_count);
    std::vector<int32_t> chart_of_face;
    std::vector<ck::texture::Vec3> directions;
    {
      ck::texture::Clustering clustering(mesh, *options);
      clustering.merge(control);
      clustering.absorb_small();
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
