#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "ck_texture.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace ck::texture {
namespace {

/// Number of consecutive nodes that one thread processes. Chosen: half a millisecond per pass; on a
/// mesh in the order of an octree, 4 % of the triangles then are at a border (boot, 3 million
/// triangles).
constexpr size_t kBlock = 16384;

/// Vectorizes a loop over labels without unrolling: few nodes have the 16 labels from which the
/// compiler's default would be used.
#define CK_SHORT_LOOP _Pragma("clang loop vectorize_width(4) interleave_count(1)")

/// Number of labels that are processed by one instruction. Chosen: few nodes have many.
constexpr size_t kLanes = 4;

/// The value of `Arc::matches` that stands for equal labels.
constexpr uint32_t kUniform = std::numeric_limits<uint32_t>::max();

/// An edge as seen from one of its nodes.
struct Arc {
  /// The other node.
  uint32_t to;
  float weight;
  /// Index of the edge's message, which has room for the labels of either node.
  uint32_t message;
  /// Index of the first of the other node's matches; `kUniform` if the nodes have the same labels.
  uint32_t matches;
  /// Whether the other node comes later in the order.
  bool is_later;
};

/// Sequential tree-reweighted message passing (TRW-S) for a Potts model with a separate label set
/// at each node.
///
/// The method processes the nodes in some order, forward and backward, and each needs the messages
/// of adjacent nodes. Here, the order is: in each block of consecutive nodes those that are only
/// adjacent to nodes of the block; then all others, which are at a border. Hence blocks don't
/// depend on each other, and threads process several at a time.
class TreeReweighted {
 public:
  TreeReweighted(const ck_label_problem& problem, const ck_control* control)
      : count_(problem.node_count),
        offsets_(problem.offsets),
        labels_(problem.labels),
        costs_(problem.costs) {
    for (uint32_t i = 0; i < count_; ++i) largest_ = std::max(largest_, size(i));
    require(largest_ < std::numeric_limits<uint16_t>::max(), "a node has too many candidates");
    connect(problem.edge_count, problem.edges);
    shares_.resize(count_);
    for_each_node(control, [&](uint32_t i) { share(i); });
    match(control);
  }

  /// One pass over the nodes in forward or backward order.
  void pass(bool forward, const ck_control* control) {
    if (!forward) pass_borders(forward);
    for_each_block(control, [&](uint32_t begin, uint32_t end) {
      Scratch scratch(largest_);
      for (uint32_t k = begin; k < end; ++k) {
        const uint32_t i = forward ? k : begin + (end - 1 - k);
        if (!is_at_border_[i]) visit(i, forward, &scratch);
      }
    });
    if (forward) pass_borders(forward);
  }

  /// Assigns labels node by node, given the labels of the previous nodes and the messages of the
  /// following ones; after a backward pass.
  void decide(const ck_control* control, int32_t* choices) const {
    for_each_block(control, [&](uint32_t begin, uint32_t end) {
      Scratch scratch(largest_);
      for (uint32_t i = begin; i < end; ++i) {
        if (!is_at_border_[i]) decide(i, choices, &scratch);
      }
    });
    Scratch scratch(largest_);
    for (const uint32_t i : borders_) decide(i, choices, &scratch);
  }

 private:
  /// Values for each label of a node.
  struct Scratch {
    explicit Scratch(size_t size) : belief(size), message(size + 1) {}
    /// The node's costs plus all incoming messages.
    std::vector<float> belief;
    /// One more: infinity, for a label that the node doesn't have.
    std::vector<float> message;
  };

  size_t size(uint32_t node) const { return offsets_[node + 1] - offsets_[node]; }

  /// Calls `body(begin, end)` for the nodes of every block.
  template <typename Body>
  void for_each_block(const ck_control* control, Body&& body) const {
    parallel_for(control, (count_ + kBlock - 1) / kBlock, [&](size_t block) {
      body(static_cast<uint32_t>(block * kBlock),
           static_cast<uint32_t>(std::min(count_, (block + 1) * kBlock)));
    });
  }

  template <typename Body>
  void for_each_node(const ck_control* control, Body&& body) const {
    for_each_block(control, [&](uint32_t begin, uint32_t end) {
      for (uint32_t i = begin; i < end; ++i) body(i);
    });
  }

  /// Sets the arcs, their messages, and which nodes are at a border.
  void connect(size_t edge_count, const ck_label_edge* edges) {
    first_.assign(count_ + 1, 0);
    is_at_border_.assign(count_, false);
    const auto is_used = [&](uint32_t a, uint32_t b) {
      return size(a) > 0 && size(b) > 0 && a != b;
    };
    for (size_t e = 0; e < edge_count; ++e) {
      const auto [a, b] = edges[e].nodes;
      require(a < count_ && b < count_, "an edge refers to a node that does not exist");
      if (!is_used(a, b)) continue;
      ++first_[a + 1];
      ++first_[b + 1];
      if (a / kBlock != b / kBlock) is_at_border_[a] = is_at_border_[b] = true;
    }
    for (uint32_t i = 0; i < count_; ++i) {
      first_[i + 1] += first_[i];
      if (is_at_border_[i]) borders_.push_back(i);
    }
    arcs_.resize(first_[count_]);
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    uint32_t total = 0;
    for (size_t e = 0; e < edge_count; ++e) {
      const auto [a, b] = edges[e].nodes;
      if (!is_used(a, b)) continue;
      arcs_[next[a]++] = {b, edges[e].weight, total, kUniform, comes_before(a, b)};
      arcs_[next[b]++] = {a, edges[e].weight, total, kUniform, comes_before(b, a)};
      total += static_cast<uint32_t>(std::max(size(a), size(b)));
    }
    messages_.assign(total, 0);
  }

  /// Whether node `a` precedes node `b` in the order.
  bool comes_before(uint32_t a, uint32_t b) const {
    return is_at_border_[a] == is_at_border_[b] ? a < b : !is_at_border_[a];
  }

  /// Sets the share of a node's belief that each of its chains gets.
  void share(uint32_t i) {
    size_t before = 0, after = 0;
    for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) ++(arcs_[a].is_later ? after : before);
    shares_[i] = 1.0f / static_cast<float>(std::max<size_t>({before, after, 1}));
  }

  /// Finds the labels of adjacent nodes among those of each node. On a mesh, most adjacent
  /// triangles are seen by the same photos (71 %: boot, 3 million triangles).
  void match(const ck_control* control) {
    for_each_node(control, [&](uint32_t i) {
      for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) {
        if (!has_labels_of(i, arcs_[a].to)) arcs_[a].matches = 0;
      }
    });
    uint32_t total = 0;
    for (Arc& arc : arcs_) {
      if (arc.matches == kUniform) continue;
      arc.matches = total;
      total += static_cast<uint32_t>(size(arc.to));
    }
    matches_.resize(total);
    for_each_node(control, [&](uint32_t i) {
      for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) {
        if (arcs_[a].matches != kUniform) match(i, arcs_[a]);
      }
    });
  }

  bool has_labels_of(uint32_t a, uint32_t b) const {
    return std::equal(labels_ + offsets_[a], labels_ + offsets_[a + 1], labels_ + offsets_[b],
                      labels_ + offsets_[b + 1]);
  }

  void match(uint32_t i, const Arc& arc) {
    const int32_t* own = labels_ + offsets_[i];
    const int32_t* other = labels_ + offsets_[arc.to];
    const size_t count = size(i);
    size_t k = 0;
    for (size_t l = 0; l < size(arc.to); ++l) {
      while (k < count && own[k] < other[l]) ++k;
      const bool is_shared = k < count && own[k] == other[l];
      matches_[arc.matches + l] = static_cast<uint16_t>(is_shared ? k : count);
    }
  }

  void pass_borders(bool forward) {
    Scratch scratch(largest_);
    for (size_t k = 0; k < borders_.size(); ++k) {
      visit(borders_[forward ? k : borders_.size() - 1 - k], forward, &scratch);
    }
  }

  /// Sends messages to the adjacent nodes that are still to be visited in this pass.
  ///
  /// A message of an adjacent node is not needed again before that node replaces it, so the message
  /// in the other direction takes its place.
  void visit(uint32_t i, bool forward, Scratch* scratch) {
    const size_t count = size(i);
    if (count == 0) return;
    float* __restrict belief = scratch->belief.data();
    std::copy(costs_ + offsets_[i], costs_ + offsets_[i + 1], belief);
    for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) {
      const float* __restrict message = messages_.data() + arcs_[a].message;
      CK_SHORT_LOOP
      for (size_t l = 0; l < count; ++l) belief[l] += message[l];
    }
    const float share = shares_[i];
    CK_SHORT_LOOP
    for (size_t l = 0; l < count; ++l) belief[l] *= share;
    for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) {
      if (arcs_[a].is_later == forward) send(i, arcs_[a], scratch);
    }
  }

  /// Replaces the message that an arc has brought by the one in the other direction.
  void send(uint32_t i, const Arc& arc, Scratch* scratch) {
    const size_t count = size(i);
    const float* __restrict belief = scratch->belief.data();
    float* __restrict out = scratch->message.data();
    float* __restrict message = messages_.data() + arc.message;
    CK_SHORT_LOOP
    for (size_t l = 0; l < count; ++l) out[l] = belief[l] - message[l];
    const float smallest = minimum(out, count), weight = arc.weight;
    if (arc.matches == kUniform) {
      CK_SHORT_LOOP
      for (size_t l = 0; l < count; ++l) message[l] = std::min(weight, out[l] - smallest);
      return;
    }
    out[count] = std::numeric_limits<float>::infinity();
    const uint16_t* matches = matches_.data() + arc.matches;
    const size_t other_count = size(arc.to);
    for (size_t l = 0; l < other_count; ++l) {
      message[l] = std::min(weight, out[matches[l]] - smallest);
    }
  }

  /// The smallest of the values, in four lanes, which the compiler makes one vector.
  static float minimum(const float* values, size_t count) {
    std::array<float, kLanes> least;
    least.fill(std::numeric_limits<float>::max());
    size_t l = 0;
    for (; l + kLanes <= count; l += kLanes) {
      for (size_t k = 0; k < kLanes; ++k) least[k] = std::min(least[k], values[l + k]);
    }
    for (; l < count; ++l) least[0] = std::min(least[0], values[l]);
    return std::min({least[0], least[1], least[2], least[3]});
  }

  void decide(uint32_t i, int32_t* choices, Scratch* scratch) const {
    const size_t count = size(i);
    choices[i] = -1;
    if (count == 0) return;
    float* belief = scratch->belief.data();
    std::copy(costs_ + offsets_[i], costs_ + offsets_[i + 1], belief);
    for (uint32_t a = first_[i]; a < first_[i + 1]; ++a) {
      const Arc& arc = arcs_[a];
      if (arc.is_later) {
        for (size_t l = 0; l < count; ++l) belief[l] += messages_[arc.message + l];
        continue;
      }
      const int32_t other = labels_[offsets_[arc.to] + static_cast<uint32_t>(choices[arc.to])];
      for (size_t l = 0; l < count; ++l) {
        if (labels_[offsets_[i] + l] != other) belief[l] += arc.weight;
      }
    }
    choices[i] = static_cast<int32_t>(std::min_element(belief, belief + count) - belief);
  }

  size_t count_;
  const uint32_t* offsets_;
  const int32_t* labels_;
  const float* costs_;
  /// The number of candidates of the node with most.
  size_t largest_ = 0;
  /// Arcs of node i: `arcs_[first_[i]..<first_[i + 1]]`.
  std::vector<uint32_t> first_;
  std::vector<Arc> arcs_;
  /// For the labels of an arc's other node, their indices among those of the node; the number of
  /// its labels if it lacks one.
  std::vector<uint16_t> matches_;
  /// The nodes with a neighbor in another block, ascending.
  std::vector<uint32_t> borders_;
  std::vector<uint8_t> is_at_border_;
  std::vector<float> shares_;
  /// One per edge: the latest in either direction.
  std::vector<float> messages_;
};

}  // namespace
}  // namespace ck::texture

ck_status ck_select_labels(const ck_label_problem* problem, size_t iterations,
                           const ck_control* control, int32_t* choices) {
  return ck::guarded([&] {
    ck::require(problem && problem->offsets && choices, "an argument is missing");
    ck::texture::TreeReweighted solver(*problem, ck::ProgressPart(control, 0, 0).control());
    const size_t passes = 2 * iterations;
    for (size_t i = 0; i < passes; ++i) {
      const double begin = static_cast<double>(i), all = static_cast<double>(passes);
      const ck::ProgressPart part(control, begin / all, (begin + 1) / all);
      solver.pass(i % 2 == 0, part.control());
    }
    solver.decide(ck::ProgressPart(control, 1, 1).control(), choices);
  });
}
