#pragma once

#include "core/random.h"
#include "patches/grid.h"
#include "patches/wavefront.h"

namespace ck::patches {

/// A pixel of a wave with its best plane so far.
struct Candidate {
  Cell cell;
  Plane plane;
  float cost;
  unsigned sources;
  /// What the grid held before.
  struct {
    Plane plane;
    float cost;
  } inherited;
  ReferencePatch reference;
  Samples samples[2];
  /// Which of the two belongs to the best plane.
  int current;
  /// Of the perturbations.
  Random random{0};
  /// A plane was taken that the grid did not hold.
  bool is_new;

  /// No plane so far can be seen in any source.
  bool is_empty() const { return !(plane.w > 0) || cost >= kNoPatch; }
};

/// Optimises the patches of a wave's pixels photometrically: holds the best plane of each so far
/// and tries others, a plane for each pixel at a time.
class PatchOptimiser {
 public:
  PatchOptimiser(Grid& grid, const Comparison& comparison, const Kernels& kernels)
      : grid_(grid), comparison_(comparison), kernels_(kernels) {}

  /// Takes up the pixels and scores the planes that the grid holds.
  void start(const Cell* cells, int count);

  /// Takes up the pixels and scores a plane of each. `support` says how much the texels count, null
  /// for all alike.
  void start(const Cell* cells, const Plane* planes, const float (*support)[kTexels], int count);

  /// Offers each pixel the plane `propose(const Cell&)`, unless that is the best one so far but for
  /// a fraction of a pixel. A plane without inverse depth is no offer.
  template <typename Propose>
  void offer_different(const Propose& propose) {
    Plane planes[kWaveSize];
    for (int i = 0; i < count_; ++i) planes[i] = propose(pixels_[i].cell);
    offer_each(planes);
  }

  /// Tries random planes around the best ones, ever closer to them.
  void perturb(int count, uint32_t seed);

  /// Takes Gauss–Newton steps as long as the cost falls; at wish only from new planes.
  void refine(int steps, bool only_new);

  /// Where texture hardly stands out from noise, takes back the patch that the grid held if it cost
  /// less: that of the coarser level, whose patches are wider and whose noise is lower.
  void settle();

  /// Writes the patches of the pixels to the grid.
  void finish();

  const Candidate* begin() const { return pixels_; }
  const Candidate* end() const { return pixels_ + count_; }

 private:
  /// Planes to be scored, at most one a pixel.
  struct Trials {
    Trial trials[kWaveSize];
    /// Whose they are.
    int pixels[kWaveSize];
    int count = 0;
  };

  /// Offers a plane to each pixel; see `offer_different`.
  void offer_each(const Plane* planes);

  /// Adds a plane for the pixel if it is plausible.
  void add(Trials& trials, int pixel, const Plane& plane);

  /// Scores the planes and takes those that cost less; leaves the pixels for which that is so.
  void run(Trials& trials);

  /// Pixels of a source by which a change of plane moves the patch's texels, at most.
  float motion(const Plane& from, const Plane& to) const;

  Grid& grid_;
  const Comparison& comparison_;
  const Kernels& kernels_;
  Candidate pixels_[kWaveSize];
  int count_ = 0;
};

}  // namespace ck::patches
