#pragma once

#include <array>
#include <vector>

#include "texture/bitmap.h"

namespace ck::texture {

/// The texels of a chart at one scale and turn, and what of them a search looks at first.
struct Stamp {
  /// A row's texels or blocks from…to (both included).
  struct Run {
    int row = 0, from = 0, to = -1;
    int length() const { return to - from + 1; }
  };

  static constexpr int kLevels = 3;
  /// Texels a side of the blocks of a level.
  static constexpr int block_side(int level) { return 4 << level; }

  Bitmap texels;
  /// All rows, in the order to look at them.
  std::vector<int> rows;
  /// The longest run of each quarter of the rows.
  std::array<Run, 4> widest;
  /// How coarsely to look for a place.
  int level = 0;
  /// Blocks that the stamp covers wherever in a block of the sheet its corner is, a run a row; in
  /// the order to look at them.
  std::vector<Run> core;

  explicit Stamp(Bitmap bitmap);

 private:
  void find_core();
};

/// A square texture that fills with charts.
///
/// What is taken includes the padding around each chart, so that a new one may touch it: the space
/// between two charts is counted once. Coarse pictures of it, a texel a block, rule out most places
/// for most charts.
class Sheet {
 public:
  explicit Sheet(int side);

  /// The first place from the top, then from the left, where the stamp is on free texels and ends
  /// above `limit`.
  bool find(const Stamp& stamp, int limit, int* x, int* y);

  /// Takes the stamp's texels and those around it.
  void take(const Stamp& stamp, int padding, int x, int y);

 private:
  struct Summary {
    int block;
    /// Blocks where any texel of the 1, 2, 4… blocks from there on to the right is taken.
    std::vector<Bitmap> spread;
    /// The longest run of free blocks of each row.
    std::vector<int> gaps;

    Summary(int block_side, int blocks);
    void update(const Bitmap& taken, int first_row, int last_row);
  };

  bool candidates(const Stamp& stamp, const Summary& summary, int block_row,
                  std::vector<uint64_t>* free) const;
  bool may_fit(const Stamp& stamp, int y) const;
  int collision(const Stamp& stamp, int x, int y, int* row) const;
  int row_collision(const Stamp& stamp, int x, int y, int row) const;
  void summarize(int first_row, int last_row);

  int side_;
  Bitmap taken_;
  /// The longest run of free texels of each row.
  std::vector<int> gaps_;
  std::vector<Summary> summaries_;
  /// The row of blocks that received the last stamp of a height and width.
  static constexpr int kTiny = 16;
  std::vector<int> tried_;
};

}  // namespace ck::texture
