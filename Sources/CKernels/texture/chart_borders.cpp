#include "texture/chart_borders.h"

#include <algorithm>
#include <cmath>

namespace ck::texture {
namespace {

/// Cost of area lost to foreshortening, relative to boundary length in units of a typical chart's
/// width. Chosen.
constexpr float kStretchCost = 6;
/// Largest number of rounds over the boundaries. Chosen.
constexpr int kPasses = 4;

/// Lower bound of the cosine by which foreshortening is weighted. Chosen: by trial.
constexpr float kMinimumForeshortening = 0.05f;

/// A cluster's area, weighted by its foreshortening along an axis.
float stretched_area(const Cluster& c, Vec3 axis) {
  const float along = dot(c.normal_sum, axis);
  return c.area * (c.area / std::max(along, kMinimumForeshortening * c.area));
}

}  // namespace

bool fits(const Cluster& c, Vec3 axis, float minimum_cosine) {
  if (dot(c.cone.axis, c.cone.axis) == 0) return true;
  const float between = std::acos(std::clamp(dot(c.cone.axis, axis), -1.0f, 1.0f));
  return between + c.cone.angle < std::acos(minimum_cosine);
}

ChartBorders::ChartBorders(const ClusterGraph& graph, const std::vector<Vec3>& axes,
                           double typical_length, float maximum_angle,
                           std::vector<uint32_t>* charts)
    : graph_(graph),
      axes_(axes),
      typical_length_(static_cast<float>(typical_length)),
      minimum_cosine_(std::cos(maximum_angle)),
      charts_(*charts) {}

void ChartBorders::shorten() {
  for (int round = 0; round < kPasses && pass(); ++round) {
  }
}

/// One round over all clusters; false if none has moved.
bool ChartBorders::pass() {
  bool has_changed = false;
  for (uint32_t i = 0; i < graph_.clusters.size(); ++i) {
    const uint32_t best = better_chart(i);
    if (best == charts_[i] || disconnects(i)) continue;
    charts_[i] = best;
    has_changed = true;
  }
  return has_changed;
}

/// The chart that a cluster should belong to; its current chart if moving it brings no gain.
uint32_t ChartBorders::better_chart(uint32_t cluster) {
  const uint32_t own = charts_[cluster];
  list_charts_around(cluster);
  if (around_.empty() || inside_ == 0) return own;
  const Cluster& c = graph_.clusters[cluster];
  const float before = stretched_area(c, axes_[own]);
  uint32_t best = own;
  float most = 0;
  for (const Neighbor& other : around_) {
    const float more = stretched_area(c, axes_[other.cluster]) - before;
    const float gain = other.length - inside_ - kStretchCost * more / typical_length_;
    if (gain <= most || !fits(c, axes_[other.cluster], minimum_cosine_)) continue;
    best = other.cluster;
    most = gain;
  }
  return best;
}

/// Collects the adjacent charts of a cluster with the lengths of the common boundaries.
void ChartBorders::list_charts_around(uint32_t cluster) {
  around_.clear();
  inside_ = 0;
  for (const Neighbor& n : graph_.neighbors_of(cluster)) {
    const uint32_t chart = charts_[n.cluster];
    if (chart == charts_[cluster]) {
      inside_ += n.length;
      continue;
    }
    const auto place = std::find_if(around_.begin(), around_.end(),
                                    [&](const Neighbor& a) { return a.cluster == chart; });
    if (place == around_.end()) {
      around_.push_back({chart, n.length});
    } else {
      place->length += n.length;
    }
  }
}

/// Whether moving a cluster would disconnect the rest of its chart locally.
bool ChartBorders::disconnects(uint32_t cluster) {
  ring_.clear();
  for (const Neighbor& n : graph_.neighbors_of(cluster)) {
    if (charts_[n.cluster] == charts_[cluster]) ring_.push_back(n.cluster);
  }
  // The first `reached` clusters of the ring are connected.
  size_t reached = std::min<size_t>(1, ring_.size());
  for (size_t k = 0; k < reached; ++k) {
    for (const Neighbor& n : graph_.neighbors_of(ring_[k])) {
      const auto place =
          std::find(ring_.begin() + static_cast<ptrdiff_t>(reached), ring_.end(), n.cluster);
      if (place != ring_.end()) std::swap(*place, ring_[reached++]);
    }
  }
  return reached < ring_.size();
}

}  // namespace ck::texture
