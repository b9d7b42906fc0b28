#pragma once

#include "patches/grid.h"

namespace ck::patches {

/// Optimises the patch of one pixel photometrically: holds the best plane so far and tries others.
class PatchOptimiser {
 public:
  /// Scores the plane that the grid holds over `sources`, a bit mask.
  PatchOptimiser(Grid& grid, const Comparison& comparison, const Kernels& kernels, int x, int y,
                 uint8_t sources);

  /// Takes the plane if it costs less.
  bool offer(const Plane& plane);

  /// Tries random planes around the best one, ever closer to it.
  void perturb(int count, uint32_t seed);

  /// Takes Gauss–Newton steps as long as the cost falls.
  void refine(int steps);

  /// No plane so far can be seen in any source.
  bool is_empty() const { return !(plane_.w > 0) || score_.cost >= 2; }

 private:
  const Comparison& comparison_;
  const Kernels& kernels_;
  const int x_, y_;
  Plane& plane_;
  Score& score_;
  const uint8_t sources_;
  ReferencePatch reference_;
  Samples samples_[2];
  /// Which of the two belongs to the best plane.
  int current_ = 0;
};

}  // namespace ck::patches
