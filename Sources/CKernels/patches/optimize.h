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
  /// The plane and cost of the grid before the optimization.
  struct {
    Plane plane;
    float cost;
  } inherited;
  ReferencePatch reference;
  Samples samples[2];
  /// Index of the samples that belong to the best plane.
  int current;
  /// Generator of the perturbations.
  Random random{0};
  /// The best plane differs from the one in the grid.
  bool is_new;

  /// No plane tested so far is visible in any source.
  bool is_empty() const { return !(plane.w > 0) || cost >= kNoPatch; }
};

/// Photometric optimization of the patches of a wave: keeps the best plane of each pixel and tests
/// candidate planes, one per pixel at a time.
class PatchOptimizer {
 public:
  PatchOptimizer(Grid& grid, const Comparison& comparison, const Kernels& kernels)
      : grid_(grid), comparison_(comparison), kernels_(kernels) {}

  /// Starts with the given pixels and scores the planes of the grid.
  void start(const Cell* cells, int count);

  /// Starts with the given pixels and scores one plane for each. `support` holds the weights of the
  /// texels, or null for uniform weights.
  void start(const Cell* cells, const Plane* planes, const float (*support)[kTexels], int count);

  /// Tests the plane `propose(const Cell&)` at each pixel, unless it differs from the best one by
  /// only a fraction of a pixel. A plane without inverse depth is skipped.
  template <typename Propose>
  void test_distinct(const Propose& propose) {
    Plane planes[kWaveSize];
    for (int i = 0; i < count_; ++i) planes[i] = propose(pixels_[i].cell);
    test_each(planes);
  }

  /// Tests random perturbations of the best planes with decreasing range.
  void perturb(int count, uint32_t seed);

  /// Takes Gauss–Newton steps as long as the cost falls; optionally only from new planes.
  void refine(int steps, bool only_new);

  /// Reverts to the inherited patch of the coarser level where texture is close to the noise level
  /// and the inherited cost is lower: coarser patches cover a larger area and have less noise.
  void revert_to_coarse_if_weak();

  /// Writes the patches of the pixels to the grid.
  void finish();

  const Candidate* begin() const { return pixels_; }
  const Candidate* end() const { return pixels_ + count_; }

 private:
  /// Planes to score, at most one per pixel.
  struct Trials {
    Trial trials[kWaveSize];
    /// Indices of their pixels.
    int pixels[kWaveSize];
    int count = 0;
  };

  /// Tests a plane at each pixel; see `test_distinct`.
  void test_each(const Plane* planes);

  /// Adds a plane for the pixel if it is plausible.
  void add(Trials& trials, int pixel, const Plane& plane);

  /// Scores the planes and accepts those with a lower cost; keeps only the accepted trials.
  void run(Trials& trials);

  /// Upper bound on the displacement of the patch's texels in a source between two planes, in
  /// pixels.
  float motion(const Plane& from, const Plane& to) const;

  Grid& grid_;
  const Comparison& comparison_;
  const Kernels& kernels_;
  Candidate pixels_[kWaveSize];
  int count_ = 0;
};

}  // namespace ck::patches
