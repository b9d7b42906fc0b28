#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"

/// Sparse grids of an octree's levels, in bricks of 8³ cells.
///
/// A level of depth d divides the unit cube into 2^d cells per axis. A cell and the node at its
/// lowest corner have the same coordinates, so that nodes go to 2^d.
namespace ck::poisson {

/// Cells of a brick per axis. Chosen: a brick's values take 2 KB.
constexpr int kSide = 8;
constexpr int kBrick = kSide * kSide * kSide;
/// Limit: a brick's nodes per axis with those around it.
constexpr int kPadded = kSide + 2;

using Coordinates = std::array<int, 3>;
using Mask = std::bitset<kBrick>;

/// The index of a node or cell in its brick.
constexpr size_t local_index(const Coordinates& c) {
  return static_cast<size_t>(((c[2] & 7) * kSide + (c[1] & 7)) * kSide + (c[0] & 7));
}
/// The coordinates of an index in its brick.
constexpr Coordinates local_coordinates(int index) {
  return {index & 7, index >> 3 & 7, index >> 6};
}
constexpr size_t padded_index(int x, int y, int z) {
  return static_cast<size_t>((z * kPadded + y) * kPadded + x);
}

/// Interleaves the bits of coordinates below 2^21 (Morton order).
uint64_t morton(const Coordinates& c);
Coordinates from_morton(uint64_t code);

/// Codes of bricks, without most repetitions.
class BrickCodes {
 public:
  /// Adds the bricks of the nodes from `before` before to `after` after a cell, per axis, of a
  /// level with `side` cells per axis.
  void add(const Coordinates& cell, int before, int after, int side);
  /// The codes in ascending order, without repetitions.
  std::vector<uint64_t> take();

 private:
  std::vector<uint64_t> codes_;
  size_t limit_ = 1 << 20;
};

/// The codes of all parts.
std::vector<uint64_t> merged(const std::vector<std::vector<uint64_t>>& parts);

/// Bricks of one level in Morton order.
class BrickSet {
 public:
  BrickSet() = default;
  /// `codes` are the Morton codes of the bricks' coordinates, in any order, with repetitions.
  BrickSet(std::vector<uint64_t> codes, const ck_control* control);

  size_t count() const { return codes_.size(); }
  uint64_t code(size_t brick) const { return codes_[brick]; }
  /// In units of bricks.
  Coordinates coordinates(size_t brick) const { return from_morton(codes_[brick]); }
  /// The brick with these coordinates; −1 if there is none.
  int32_t find(const Coordinates& brick) const;
  /// The brick at an offset of −1 to 1 per axis; −1 if there is none.
  int32_t neighbor(size_t brick, int x, int y, int z) const {
    return neighbors_[brick][static_cast<size_t>((z + 1) * 9 + (y + 1) * 3 + x + 1)];
  }
  /// The bricks whose coordinates have the same remainders by `period`, for every remainder: no two
  /// of a list are closer than that.
  std::vector<std::vector<uint32_t>> colors(int period) const;

 private:
  std::vector<uint64_t> codes_;
  std::vector<std::array<int32_t, 27>> neighbors_;
};

/// Calls `body(brick)` for all bricks, one color after the other, those of one color
/// concurrently. The work on a brick is that of `samples` samples on average.
template <typename Body>
void for_colors(const BrickSet& bricks, int period, const ck_control* control, Body&& body,
                size_t samples = 0) {
  // Chosen: starting threads takes longer than a few bricks with few samples.
  constexpr size_t kFewBricks = 32, kFewSamples = 1024;
  const auto colors = bricks.colors(period);
  size_t done = 0;
  for (const std::vector<uint32_t>& color : colors) {
    const double count = static_cast<double>(bricks.count());
    const ProgressPart part(control, done / count, (done + color.size()) / count);
    ck_control own = *part.control();
    if (color.size() < kFewBricks && samples < kFewSamples) own.threads = 1;
    parallel_for(&own, color.size(), [&](size_t k) { body(color[k]); });
    done += color.size();
  }
}

}  // namespace ck::poisson
