#pragma once

#include <array>
#include <vector>

#include "texture/bitmap.h"

namespace ck::texture {

/// The texels of a chart at one scale and rotation, with precomputed data for the placement search.
struct ChartMask {
  /// A run of texels or blocks of a row, from…to (both included).
  struct Run {
    int row = 0, from = 0, to = -1;
    int length() const { return to - from + 1; }
  };

  /// Number of resolution levels. Chosen.
  static constexpr int kLevels = 3;
  /// Side in texels of the blocks of a level.
  static constexpr int block_side(int level) { return 4 << level; }

  Bitmap texels;
  /// All rows, in the order in which to test them.
  std::vector<int> rows;
  /// The longest run in each quarter of the rows.
  std::array<Run, 4> widest;
  /// Resolution level of the search.
  int level = 0;
  /// Blocks that the mask covers wherever in a page block its corner lies, one run per row; in the
  /// order in which to test them.
  std::vector<Run> core;

  explicit ChartMask(Bitmap bitmap);

 private:
  void find_core();
};

/// Occupancy of a square atlas page.
///
/// Occupied texels include the padding around each chart, and a new chart may touch it: the padding
/// between two charts is counted once. Coarser occupancy bitmaps with one bit per block exclude
/// most positions of most charts.
class AtlasOccupancy {
 public:
  explicit AtlasOccupancy(int side);

  /// The first position, from the top, then from the left, where the mask is on free texels and
  /// ends above `limit`; false if there is none.
  bool find(const ChartMask& mask, int limit, int* x, int* y);

  /// Marks the texels of a mask and the padding around them as occupied.
  void place(const ChartMask& mask, int padding, int x, int y);

 private:
  /// The occupancy at one block size.
  struct Summary {
    int block;
    /// By level: blocks from which any of the next 1, 2, 4… blocks to the right is occupied.
    std::vector<Bitmap> spread;
    /// The longest run of free blocks of each row.
    std::vector<int> clear_runs;

    Summary(int block_side, int blocks);
    void update(const Bitmap& occupied, int first_row, int last_row);
  };

  bool candidates(const ChartMask& mask, const Summary& summary, int block_row,
                  std::vector<uint64_t>* free) const;
  bool may_fit(const ChartMask& mask, int y) const;
  int collision(const ChartMask& mask, int x, int y, int* row) const;
  int row_collision(const ChartMask& mask, int x, int y, int row) const;
  void summarize(int first_row, int last_row);

  int side_;
  Bitmap occupied_;
  /// The longest run of free texels of each row.
  std::vector<int> clear_runs_;
  std::vector<Summary> summaries_;
  /// Largest side in texels of a tiny mask. Chosen.
  static constexpr int kTiny = 16;
  /// By height and width: the row of blocks in which the last tiny mask of that size was placed.
  std::vector<int> tried_;
};

}  // namespace ck::texture
