#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ck_texture.h"
#include "core/guard.h"

namespace ck::texture {
namespace {

/// One direction of an edge of the graph.
struct Arc {
  uint32_t to;
  float weight;
  /// Index of the first message that arrives at this arc's source.
  uint32_t incoming;
  /// Index of the first message that leaves this arc's source.
  uint32_t outgoing;
};

/// Sequential tree-reweighted message passing (TRW-S) for a Potts model with a separate label set
/// at each node.
class TreeReweighted {
 public:
  explicit TreeReweighted(const ck_label_problem& problem)
      : count_(problem.node_count),
        offsets_(problem.offsets),
        labels_(problem.labels),
        costs_(problem.costs) {
    connect(problem.edge_count, problem.edges, problem.edge_weights);
    shares_.resize(count_);
    for (uint32_t i = 0; i < count_; ++i) {
      size_t before = 0, after = 0;
      for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) ++(arcs_[a].to < i ? before : after);
      shares_[i] = 1.0f / static_cast<float>(std::max<size_t>({before, after, 1}));
    }
  }

  /// One pass over the nodes in ascending or descending order.
  void pass(bool forward) {
    for (size_t k = 0; k < count_; ++k) {
      const auto i = static_cast<uint32_t>(forward ? k : count_ - 1 - k);
      if (size(i) == 0) continue;
      gather(i);
      for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) {
        if ((arcs_[a].to > i) == forward) send(i, arcs_[a]);
      }
    }
  }

  /// Assigns labels node by node, given the labels of the previous nodes and the messages of the
  /// following ones.
  void decide(int32_t* choices) {
    for (uint32_t i = 0; i < count_; ++i) {
      choices[i] = -1;
      if (size(i) == 0) continue;
      belief_.assign(costs_ + offsets_[i], costs_ + offsets_[i + 1]);
      for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) {
        const Arc& arc = arcs_[a];
        if (arc.to < i) {
          const int32_t other = labels_[offsets_[arc.to] + static_cast<uint32_t>(choices[arc.to])];
          for (size_t l = 0; l < size(i); ++l) {
            if (labels_[offsets_[i] + l] != other) belief_[l] += arc.weight;
          }
        } else {
          for (size_t l = 0; l < size(i); ++l) belief_[l] += messages_[arc.incoming + l];
        }
      }
      choices[i] =
          static_cast<int32_t>(std::min_element(belief_.begin(), belief_.end()) - belief_.begin());
    }
  }

 private:
  size_t size(uint32_t node) const { return offsets_[node + 1] - offsets_[node]; }

  void connect(size_t edge_count, const uint32_t* edges, const float* weights) {
    first_.assign(count_ + 1, 0);
    const auto used = [&](size_t e) {
      return size(edges[2 * e]) > 0 && size(edges[2 * e + 1]) > 0 &&
             edges[2 * e] != edges[2 * e + 1];
    };
    for (size_t e = 0; e < edge_count; ++e) {
      require(edges[2 * e] < count_ && edges[2 * e + 1] < count_,
              "an edge refers to a node that does not exist");
      if (!used(e)) continue;
      ++first_[edges[2 * e] + 1];
      ++first_[edges[2 * e + 1] + 1];
    }
    for (size_t i = 0; i < count_; ++i) first_[i + 1] += first_[i];
    arcs_.resize(first_[count_]);
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    uint32_t total = 0;
    for (size_t e = 0; e < edge_count; ++e) {
      if (!used(e)) continue;
      const uint32_t a = edges[2 * e], b = edges[2 * e + 1];
      const uint32_t at_a = total, at_b = at_a + static_cast<uint32_t>(size(a));
      total = at_b + static_cast<uint32_t>(size(b));
      arcs_[next[a]++] = {b, weights[e], at_a, at_b};
      arcs_[next[b]++] = {a, weights[e], at_b, at_a};
    }
    messages_.assign(total, 0);
  }

  /// The node's costs plus all incoming messages.
  void gather(uint32_t i) {
    belief_.assign(costs_ + offsets_[i], costs_ + offsets_[i + 1]);
    for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) {
      const float* message = messages_.data() + arcs_[a].incoming;
      for (size_t l = 0; l < belief_.size(); ++l) belief_[l] += message[l];
    }
  }

  void send(uint32_t i, const Arc& arc) {
    const float share = shares_[i];
    out_.resize(belief_.size());
    float smallest = std::numeric_limits<float>::max();
    for (size_t l = 0; l < belief_.size(); ++l) {
      out_[l] = share * belief_[l] - messages_[arc.incoming + l];
      smallest = std::min(smallest, out_[l]);
    }
    const int32_t* own = labels_ + offsets_[i];
    const int32_t* other = labels_ + offsets_[arc.to];
    float* message = messages_.data() + arc.outgoing;
    size_t k = 0;
    for (size_t l = 0; l < size(arc.to); ++l) {
      while (k < out_.size() && own[k] < other[l]) ++k;
      const bool shared = k < out_.size() && own[k] == other[l];
      message[l] = std::min(arc.weight, shared ? out_[k] - smallest : arc.weight);
    }
  }

  size_t count_;
  const uint32_t* offsets_;
  const int32_t* labels_;
  const float* costs_;
  std::vector<uint32_t> first_;
  std::vector<Arc> arcs_;
  std::vector<float> shares_;
  std::vector<float> messages_;
  std::vector<float> belief_;
  std::vector<float> out_;
};

}  // namespace
}  // namespace ck::texture

ck_status ck_select_labels(const ck_label_problem* problem, size_t iterations,
                           const ck_control* control, int32_t* choices) {
  return ck::guarded([&] {
    ck::require(problem && problem->offsets && choices, "an argument is missing");
    ck::texture::TreeReweighted solver(*problem);
    for (size_t i = 0; i < iterations; ++i) {
      ck::step(control, static_cast<double>(i) / static_cast<double>(iterations));
      solver.pass(true);
      solver.pass(false);
    }
    solver.decide(choices);
  });
}
