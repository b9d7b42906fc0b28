#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace ck {

/// Disjoint sets of the numbers 0..<count (union–find with path halving).
class DisjointSets {
 public:
  /// Each number is a separate set.
  explicit DisjointSets(size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  size_t count() const { return parents_.size(); }

  /// The number that represents the set of `i`.
  uint32_t root(uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  /// Unites two sets; the lower of their roots represents the union.
  void join(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

  /// Unites the set that `gone` represents with that of `kept`, whose root represents the union.
  void attach(uint32_t gone, uint32_t kept) { parents_[gone] = kept; }

  /// The root of every number.
  std::vector<uint32_t> roots() {
    std::vector<uint32_t> result(count());
    for (uint32_t i = 0; i < result.size(); ++i) result[i] = root(i);
    return result;
  }

 private:
  std::vector<uint32_t> parents_;
};

}  // namespace ck
