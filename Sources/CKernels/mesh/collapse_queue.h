#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace ck::mesh {

/// A candidate edge collapse. It is outdated once the version of an end has changed.
struct Collapse {
  uint32_t a, b;
  uint32_t version : 31;
  /// Whether the position is an end or the midpoint because the optimal position is not permitted.
  uint32_t is_fallback : 1;
};

/// A bucket queue of collapses by ascending cost, unordered among nearly equal costs (within
/// 1/128): one stack per exponent and leading mantissa bits, so that nothing is sorted. Stacks are
/// lists of blocks for better memory locality.
class CollapseQueue {
 public:
  CollapseQueue() : tops_(kStacks, kNone) {}

  /// `cost` is not negative.
  void push(float cost, const Collapse& c) {
    uint32_t bits;
    std::memcpy(&bits, &cost, sizeof bits);
    const uint32_t stack = bits >> kDroppedBits;
    uint32_t& top = tops_[stack];
    if (top == kNone || blocks_[top].count == kBlock) top = block_on(top);
    Block& block = blocks_[top];
    block.collapses[block.count++] = c;
    if (stack < lowest_) lowest_ = stack;
  }

  /// Removes the cheapest collapse; false if the queue is empty.
  bool pop(Collapse* c) {
    while (lowest_ < kStacks && tops_[lowest_] == kNone) ++lowest_;
    if (lowest_ == kStacks) return false;
    uint32_t& top = tops_[lowest_];
    Block& block = blocks_[top];
    *c = block.collapses[--block.count];
    if (block.count == 0) {
      const uint32_t below = block.next;
      block.next = free_;
      free_ = top;
      top = below;
    }
    return true;
  }

 private:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  /// Bits of the mantissa that are ignored. Chosen: the other seven distinguish 1/128.
  static constexpr uint32_t kDroppedBits = 16;
  static constexpr uint32_t kStacks = 1u << (31 - kDroppedBits);
  /// Collapses of a block. Chosen: it takes three cache lines.
  static constexpr uint32_t kBlock = 15;

  struct Block {
    std::array<Collapse, kBlock> collapses;
    uint32_t count, next;
  };

  /// An empty block on top of another.
  uint32_t block_on(uint32_t below) {
    uint32_t block = free_;
    if (block == kNone) {
      block = static_cast<uint32_t>(blocks_.size());
      blocks_.emplace_back();
    } else {
      free_ = blocks_[block].next;
    }
    blocks_[block].count = 0;
    blocks_[block].next = below;
    return block;
  }

  std::vector<Block> blocks_;
  std::vector<uint32_t> tops_;  ///< the topmost block of each stack
  uint32_t free_ = kNone, lowest_ = kStacks;
};

}  // namespace ck::mesh
