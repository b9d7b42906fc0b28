#pragma once

#include <algorithm>

#include "core/guard.h"
#include "patches/grid.h"

namespace ck::patches {

/// Sweeps over the cells of a grid such that each comes after its left and upper neighbors: from
/// top left to bottom right, or the reverse.
///
/// Cells on an antidiagonal are independent of one another. They are visited together, in waves, so
/// that the processor can work on one while another waits for memory:
///
///     row 0   · · · 3 4        wave 4 visits the cells marked 4,
///     row 1   · · 3 4          after those marked 3
///     row 2   · 3 4
///
/// A band has as many rows as a wave has cells; the next band starts after it is complete.
class Wavefront {
 public:
  Wavefront(int width, int height, bool is_forward)
      : width_(width), height_(height), is_forward_(is_forward) {}

  /// Calls `visit(Cell* cells, int count)` for each wave.
  template <typename Visit>
  void run(const ck_control* control, double progress_from, double progress_to,
           const Visit& visit) const {
    const int rows = height_ - 2 * kMargin, columns = width_ - 2 * kMargin;
    Cell cells[kWaveSize];
    for (int top = 0; top < rows; top += kWaveSize) {
      step(control, progress_from + (progress_to - progress_from) * top / rows);
      const int band = std::min(kWaveSize, rows - top);
      for (int wave = 0; wave < columns + band - 1; ++wave) {
        const int first = std::max(0, wave - columns + 1), last = std::min(wave, band - 1);
        for (int row = first; row <= last; ++row) cells[row - first] = cell(wave - row, top + row);
        visit(cells, last - first + 1);
      }
    }
  }

 private:
  Cell cell(int column, int row) const {
    const int x = kMargin + column, y = kMargin + row;
    return is_forward_ ? Cell{x, y} : Cell{width_ - 1 - x, height_ - 1 - y};
  }

  const int width_, height_;
  const bool is_forward_;
};

}  // namespace ck::patches
