#include "texture/atlas_occupancy.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace ck::texture {
namespace {

/// Smallest number of blocks across a chart mask. Chosen: fewer exclude few positions, more cost
/// time.
constexpr int kBlocksAcross = 6;
/// Limit: the golden section, whose multiples are far apart.
constexpr float kGoldenSection = 0.618f;

/// The longest run of set bits of a row.
ChartMask::Run longest_run(const uint64_t* row, int words, int y) {
  ChartMask::Run best, run;
  best.row = y;
  run.from = 0;
  bool is_open = false;
  for (int w = 0; w < words; ++w) {
    const int base = w * Bitmap::kWord;
    for (int bit = 0; bit < Bitmap::kWord;) {
      const uint64_t rest = (is_open ? ~row[w] : row[w]) & (~uint64_t{0} << bit);
      if (!rest) break;
      bit = __builtin_ctzll(rest);
      if (is_open) {
        if (base + bit - run.from > best.length()) best = {y, run.from, base + bit - 1};
      } else {
        run.from = base + bit;
      }
      is_open = !is_open;
    }
  }
  const int end = words * Bitmap::kWord;
  if (is_open && end - run.from > best.length()) best = {y, run.from, end - 1};
  return best;
}

/// 64 bits starting at `start` of a row that ends with a zero word; `start` may lie beyond the end.
uint64_t window(const uint64_t* row, int words, int start) {
  const int word = start / Bitmap::kWord, shift = start % Bitmap::kWord;
  if (word >= words) return 0;
  return row[word] >> shift | row[word + 1] << 1 << (Bitmap::kWord - 1 - shift);
}

/// A permutation of 0..<count in which successive elements are far apart.
std::vector<int> scattered(int count) {
  std::vector<int> order(static_cast<size_t>(count));
  int step = std::max(1, static_cast<int>(kGoldenSection * static_cast<float>(count)));
  while (std::gcd(step, count) > 1) ++step;
  for (int k = 0, i = count / 2; k < count; ++k, i = (i + step) % count) {
    order[static_cast<size_t>(k)] = i;
  }
  return order;
}

}  // namespace

ChartMask::ChartMask(Bitmap bitmap) : texels(std::move(bitmap)) {
  const int height = texels.height(), words = texels.words();
  for (int y = 0; y < height; ++y) {
    Run& best = widest[static_cast<size_t>(4 * y / height)];
    const Run run = longest_run(texels.row(y), words, y);
    if (run.length() > best.length()) best = run;
  }
  rows = scattered(height);
  const int extent = std::min(height, texels.width());
  while (level + 1 < kLevels && extent >= kBlocksAcross * block_side(level + 1)) ++level;
  find_core();
}

void ChartMask::find_core() {
  const int block = block_side(level), around = block - 1, words = texels.words();
  std::vector<Run> runs;
  std::vector<uint64_t> all(static_cast<size_t>(words));
  for (int row = 1; row * block + around < texels.height(); ++row) {
    // A block of the page is covered for every position within a block if the mask covers this many
    // texels around it.
    std::fill(all.begin(), all.end(), ~uint64_t{0});
    for (int y = row * block - around; y <= row * block + around; ++y) {
      for (int w = 0; w < words; ++w) all[static_cast<size_t>(w)] &= texels.row(y)[w];
    }
    const Run run = longest_run(all.data(), words, row);
    const Run cells{row, (run.from + around + block - 1) / block, (run.to - around) / block};
    if (run.length() > 2 * around && cells.length() > 0) runs.push_back(cells);
  }
  for (const int k : scattered(static_cast<int>(runs.size()))) {
    core.push_back(runs[static_cast<size_t>(k)]);
  }
}

AtlasOccupancy::Summary::Summary(int block_side, int blocks)
    : block(block_side), clear_runs(static_cast<size_t>(blocks), blocks) {
  for (int length = 1; length <= blocks; length *= 2) spread.emplace_back(blocks, blocks);
}

AtlasOccupancy::AtlasOccupancy(int side)
    : side_(side),
      occupied_(side, side),
      clear_runs_(static_cast<size_t>(side), side),
      tried_(static_cast<size_t>((kTiny + 1) * (kTiny + 1)), 0) {
  for (int level = 0; level < ChartMask::kLevels; ++level) {
    const int block = ChartMask::block_side(level);
    summaries_.emplace_back(block, (side + block - 1) / block);
  }
}

bool AtlasOccupancy::find(const ChartMask& mask, int limit, int* found_x, int* found_y) {
  const Summary& summary = summaries_[static_cast<size_t>(mask.level)];
  const int last_x = side_ - mask.texels.width();
  const int last_y = std::min(side_, limit) - mask.texels.height();
  if (last_x < 0 || last_y < 0) return false;
  std::vector<uint64_t> free(static_cast<size_t>(summary.spread[0].words()));
  // The search for a tiny mask starts at the row of blocks where the previous one of its size was
  // placed.
  const bool is_tiny = mask.texels.width() <= kTiny && mask.texels.height() <= kTiny;
  int none = 0;
  int& first =
      is_tiny
          ? tried_[static_cast<size_t>(mask.texels.height() * (kTiny + 1) + mask.texels.width())]
          : none;
  int row = 0;
  for (int block_row = first; block_row * summary.block <= last_y; ++block_row) {
    if (!candidates(mask, summary, block_row, &free)) continue;
    const int end = std::min(last_y, (block_row + 1) * summary.block - 1);
    for (int y = block_row * summary.block; y <= end; ++y) {
      row = std::max(0, row - 1);
      if (!may_fit(mask, y)) continue;
      for (int x = 0; x <= last_x;) {
        // Skip to the next block that may have room.
        const int block = x / summary.block;
        const uint64_t word = free[static_cast<size_t>(block / Bitmap::kWord)];
        const uint64_t rest = word >> (block % Bitmap::kWord);
        if (!(rest & 1)) {
          const int skip = rest ? __builtin_ctzll(rest) : Bitmap::kWord - block % Bitmap::kWord;
          x = (block + skip) * summary.block;
          continue;
        }
        const int jump = collision(mask, x, y, &row);
        if (jump == 0) {
          *found_x = x;
          *found_y = y;
          first = block_row;
          return true;
        }
        x += jump;
      }
    }
  }
  return false;
}

/// Marks the blocks of a row in which the mask's corner may lie; false if there are none.
bool AtlasOccupancy::candidates(const ChartMask& mask, const Summary& summary, int block_row,
                                std::vector<uint64_t>* free) const {
  for (const ChartMask::Run& run : mask.core) {
    if (summary.clear_runs[static_cast<size_t>(block_row + run.row)] < run.length()) return false;
  }
  const int words = summary.spread[0].words();
  // Further to the right the mask would exceed the page.
  const int last = (side_ - mask.texels.width()) / summary.block;
  for (int w = 0; w < words; ++w) {
    const int count = std::clamp(last + 1 - w * Bitmap::kWord, 0, Bitmap::kWord);
    (*free)[static_cast<size_t>(w)] = count > 0 ? ~uint64_t{0} >> (Bitmap::kWord - count) : 0;
  }
  for (const ChartMask::Run& run : mask.core) {
    // Two overlapping powers of two cover any length.
    const int level = Bitmap::kWord / 2 - 1 - __builtin_clz(static_cast<unsigned>(run.length()));
    const uint64_t* row = summary.spread[static_cast<size_t>(level)].row(block_row + run.row);
    uint64_t any = 0;
    for (int w = 0; w < words; ++w) {
      uint64_t& places = (*free)[static_cast<size_t>(w)];
      if (!places) continue;
      const int start = w * Bitmap::kWord + run.from;
      places &=
          ~(window(row, words, start) | window(row, words, start + run.length() - (1 << level)));
      any |= places;
    }
    if (!any) return false;
  }
  return true;
}

/// Whether the rows under the widest runs of the mask have free runs of at least that length.
bool AtlasOccupancy::may_fit(const ChartMask& mask, int y) const {
  return std::all_of(mask.widest.begin(), mask.widest.end(), [&](const ChartMask::Run& run) {
    return clear_runs_[static_cast<size_t>(y + run.row)] >= run.length();
  });
}

/// 0 if the mask fits, otherwise the distance to the next position to test on the right. `row` is
/// the row to test first, and receives the colliding row: the one of the previous position mostly
/// collides again.
int AtlasOccupancy::collision(const ChartMask& mask, int x, int y, int* row) const {
  if (const int jump = row_collision(mask, x, y, *row)) return jump;
  for (const int r : mask.rows) {
    if (const int jump = row_collision(mask, x, y, r)) {
      *row = r;
      return jump;
    }
  }
  return 0;
}

/// The same for a single row.
int AtlasOccupancy::row_collision(const ChartMask& mask, int x, int y, int r) const {
  const uint64_t* row = mask.texels.row(r);
  const uint64_t* occupied = occupied_.row(y + r) + x / Bitmap::kWord;
  const int shift = x % Bitmap::kWord;
  for (int w = 0; w < mask.texels.words(); ++w) {
    const uint64_t there = occupied[w] >> shift | occupied[w + 1] << 1
                                                                  << (Bitmap::kWord - 1 - shift);
    const uint64_t hit = row[w] & there;
    if (hit == 0) continue;
    // The mask has to move until the rightmost colliding texel is clear of this run.
    const int last = Bitmap::kWord - 1 - __builtin_clzll(hit);
    const uint64_t below = ~uint64_t{0} >> (Bitmap::kWord - 1 - last);
    const uint64_t clear_runs = ~row[w] & below;
    const int start = clear_runs ? Bitmap::kWord - __builtin_clzll(clear_runs) : 0;
    return last - start + 1;
  }
  return 0;
}

void AtlasOccupancy::place(const ChartMask& mask, int padding, int x, int y) {
  const Bitmap grown = mask.texels.dilated(padding);
  occupied_.add(grown, x - padding, y - padding);
  summarize(std::max(0, y - padding), std::min(side_, y + mask.texels.height() + padding) - 1);
}

/// Updates the summaries of rows first…last.
void AtlasOccupancy::summarize(int first_row, int last_row) {
  for (int y = first_row; y <= last_row; ++y) {
    clear_runs_[static_cast<size_t>(y)] = occupied_.longest_clear_run(y);
  }
  for (Summary& summary : summaries_) summary.update(occupied_, first_row, last_row);
}

void AtlasOccupancy::Summary::update(const Bitmap& occupied, int first_row, int last_row) {
  const uint64_t mask = (uint64_t{1} << block) - 1;
  for (int row = first_row / block; row <= last_row / block; ++row) {
    const int end = std::min(occupied.height(), (row + 1) * block);
    for (int w = 0; w < occupied.words(); ++w) {
      uint64_t any = 0;
      for (int y = row * block; y < end; ++y) any |= occupied.row(y)[w];
      for (int b = w * Bitmap::kWord / block; any; ++b, any >>= block) {
        if (any & mask) spread[0].set(b, row);
      }
    }
    clear_runs[static_cast<size_t>(row)] = spread[0].longest_clear_run(row);
    const int words = spread[0].words();
    for (size_t level = 1; level < spread.size(); ++level) {
      const uint64_t* from = spread[level - 1].row(row);
      uint64_t* to = spread[level].row(row);
      for (int w = 0; w < words; ++w) {
        to[w] = from[w] | window(from, words, w * Bitmap::kWord + (1 << (level - 1)));
      }
    }
  }
}

}  // namespace ck::texture
