#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace ck::texture {

/// An edge whose ends become one. It is out of date once an end's version has gone on.
struct Collapse {
  uint32_t a, b;
  uint32_t version;
};

/// Collapses by rising cost, those of nearly equal cost (within 1/128) in the order in which they
/// came: a list for each exponent and the first bits of the mantissa, so that nothing is sorted.
class CollapseQueue {
 public:
  CollapseQueue() : first_(kBuckets, kNone), last_(kBuckets, kNone) {}

  /// `cost` is not negative.
  void push(float cost, const Collapse& c) {
    uint32_t bits;
    std::memcpy(&bits, &cost, sizeof bits);
    const uint32_t bucket = bits >> kDroppedBits;
    uint32_t node = free_;
    if (node == kNone) {
      node = static_cast<uint32_t>(nodes_.size());
      nodes_.push_back({c, kNone});
    } else {
      free_ = nodes_[node].next;
      nodes_[node] = {c, kNone};
    }
    (first_[bucket] == kNone ? first_[bucket] : nodes_[last_[bucket]].next) = node;
    last_[bucket] = node;
    if (bucket < lowest_) lowest_ = bucket;
  }

  /// Takes the cheapest out; false when there is none.
  bool pop(Collapse* c) {
    while (lowest_ < kBuckets && first_[lowest_] == kNone) ++lowest_;
    if (lowest_ == kBuckets) return false;
    const uint32_t node = first_[lowest_];
    *c = nodes_[node].collapse;
    first_[lowest_] = nodes_[node].next;
    nodes_[node].next = free_;
    free_ = node;
    return true;
  }

 private:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  static constexpr uint32_t kDroppedBits = 16;
  static constexpr uint32_t kBuckets = 1u << (31 - kDroppedBits);

  struct Node {
    Collapse collapse;
    uint32_t next;
  };
  std::vector<Node> nodes_;
  std::vector<uint32_t> first_, last_;
  uint32_t free_ = kNone, lowest_ = kBuckets;
};

}  // namespace ck::texture
