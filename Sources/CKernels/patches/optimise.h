#pragma once

#include "patches/grid.h"

namespace ck::patches {

/// Optimises the patch of one pixel photometrically: holds the best plane so far and tries others.
class PatchOptimiser {
 public:
  /// Scores the plane that the grid holds.
  PatchOptimiser(Grid& grid, const Comparison& comparison, const Kernels& kernels, int x, int y);

  /// Takes the plane if it costs less.
  bool offer(const Plane& plane);

  /// Offers the plane unless it is the best one so far but for a fraction of a pixel; true where it
  /// was taken.
  bool offer_different(const Plane& plane);

  /// Tries random planes around the best one, ever closer to it.
  void perturb(int count, uint32_t seed);

  /// Takes Gauss–Newton steps as long as the cost falls.
  void refine(int steps);

  /// Where texture hardly stands out from noise, takes back the patch that the grid held if it cost
  /// less: that of the coarser level, whose patches are wider and whose noise is lower.
  void settle();

  /// No plane so far can be seen in any source.
  bool is_empty() const { return !(plane_.w > 0) || cost_ >= kNoPatch; }

 private:
  /// Pixels of a source by which the plane moves the patch's texels, at most.
  float motion_to(const Plane& plane) const;

  const Comparison& comparison_;
  const Kernels& kernels_;
  const int x_, y_;
  Plane& plane_;
  float& cost_;
  const unsigned sources_;
  /// What the grid held before.
  const struct {
    Plane plane;
    float cost;
  } inherited_;
  ReferencePatch reference_;
  Samples samples_[2];
  /// Which of the two belongs to the best plane.
  int current_ = 0;
};

}  // namespace ck::patches
