#include "surface/poisson/bricks.h"

#include <algorithm>

namespace ck::poisson {

namespace {

uint64_t spread(uint64_t x) {
  x &= 0x1FFFFF;
  x = (x | x << 32) & 0x1F00000000FFFF;
  x = (x | x << 16) & 0x1F0000FF0000FF;
  x = (x | x << 8) & 0x100F00F00F00F00F;
  x = (x | x << 4) & 0x10C30C30C30C30C3;
  return (x | x << 2) & 0x1249249249249249;
}

int gathered(uint64_t x) {
  x &= 0x1249249249249249;
  x = (x | x >> 2) & 0x10C30C30C30C30C3;
  x = (x | x >> 4) & 0x100F00F00F00F00F;
  x = (x | x >> 8) & 0x1F0000FF0000FF;
  x = (x | x >> 16) & 0x1F00000000FFFF;
  return static_cast<int>((x | x >> 32) & 0x1FFFFF);
}

void make_unique(std::vector<uint64_t>& codes) {
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
}

}  // namespace

uint64_t morton(const Coordinates& c) {
  return spread(static_cast<uint64_t>(c[0])) | spread(static_cast<uint64_t>(c[1])) << 1 |
         spread(static_cast<uint64_t>(c[2])) << 2;
}

Coordinates from_morton(uint64_t code) {
  return {gathered(code), gathered(code >> 1), gathered(code >> 2)};
}

void BrickCodes::add(const Coordinates& cell, int before, int after, int side) {
  Coordinates first, last;
  for (size_t a = 0; a < 3; ++a) {
    first[a] = std::max(cell[a] - before, 0) / kSide;
    last[a] = std::min(cell[a] + after, side) / kSide;
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const uint64_t code = morton({x, y, z});
        if (codes_.empty() || codes_.back() != code) codes_.push_back(code);
      }
    }
  }
  if (codes_.size() < limit_) return;
  make_unique(codes_);
  limit_ = std::max(limit_, 2 * codes_.size());
}

std::vector<uint64_t> BrickCodes::take() {
  make_unique(codes_);
  return std::move(codes_);
}

BrickSet::BrickSet(std::vector<uint64_t> codes, const ck_control* control)
    : codes_(std::move(codes)) {
  // Bricks that a thread works on at a time. Chosen: about a millisecond.
  constexpr size_t kBlock = 256;
  make_unique(codes_);
  neighbors_.resize(codes_.size());
  parallel_for_blocks(control, codes_.size(), kBlock, [&](size_t b) {
    const Coordinates c = coordinates(b);
    for (int i = 0; i < 27; ++i) {
      const Coordinates other{c[0] + i % 3 - 1, c[1] + i / 3 % 3 - 1, c[2] + i / 9 - 1};
      neighbors_[b][static_cast<size_t>(i)] = i == 13 ? static_cast<int32_t>(b) : find(other);
    }
  });
}

std::vector<uint64_t> merged(const std::vector<std::vector<uint64_t>>& parts) {
  std::vector<uint64_t> codes;
  for (const std::vector<uint64_t>& part : parts) {
    codes.insert(codes.end(), part.begin(), part.end());
  }
  return codes;
}

int32_t BrickSet::find(const Coordinates& brick) const {
  for (int c : brick) {
    if (c < 0 || c > 0x1FFFFF) return -1;
  }
  const uint64_t code = morton(brick);
  const auto found = std::lower_bound(codes_.begin(), codes_.end(), code);
  if (found == codes_.end() || *found != code) return -1;
  return static_cast<int32_t>(found - codes_.begin());
}

std::vector<std::vector<uint32_t>> BrickSet::colors(int period) const {
  std::vector<std::vector<uint32_t>> colors(static_cast<size_t>(period * period * period));
  for (size_t b = 0; b < count(); ++b) {
    const Coordinates c = coordinates(b);
    const int color = (c[2] % period * period + c[1] % period) * period + c[0] % period;
    colors[static_cast<size_t>(color)].push_back(static_cast<uint32_t>(b));
  }
  return colors;
}

}  // namespace ck::poisson
