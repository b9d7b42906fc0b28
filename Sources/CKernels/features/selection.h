#pragma once

#include <cstddef>
#include <vector>

namespace ck {

/// A feature as input of the selection.
struct Candidate {
  float x, y;
  /// Contrast in units of the threshold.
  float response;
};

/// Options of feature selection.
struct Selection {
  size_t maximum = 0;
  /// The threshold is lowered until this many features are found.
  size_t sufficient = 0;
  /// Initial threshold.
  float high_threshold = 0;
  /// Number of grid cells along the longer side.
  int cells = 1;
};

/// The indices of the features to keep, ascending: those above an adaptive threshold, and of these
/// the strongest of each cell of a grid, so that a textured corner does not take all.
std::vector<size_t> select_features(const std::vector<Candidate>& candidates, int width, int height,
                                    const Selection& selection);

}  // namespace ck
