#pragma once

#include <cstddef>
#include <vector>

namespace ck {

/// What the selection needs to know about a feature.
struct Candidate {
  float x, y;
  /// Contrast in the units of the threshold.
  float response;
};

/// How features are selected.
struct Selection {
  size_t maximum = 0;
  /// The threshold falls until this many are found.
  size_t sufficient = 0;
  /// Where the threshold starts.
  float high_threshold = 0;
  /// Cells along the longer side.
  int cells = 1;
};

/// The indices of the features to keep, ascending: those above a threshold that adapts to the
/// photo, of these the strongest of each cell of a grid, so that one textured corner can't take
/// all.
std::vector<size_t> select_features(const std::vector<Candidate>& candidates, int width, int height,
                                    const Selection& selection);

}  // namespace ck
