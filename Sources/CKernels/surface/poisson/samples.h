#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/span.h"
#include "core/uninitialized.h"
#include "surface/poisson/bricks.h"

namespace ck::poisson {

/// An oriented point in the unit cube.
struct Sample {
  /// 0 to less than 1 per axis.
  std::array<float, 3> position;
  /// Of unit length.
  std::array<float, 3> normal;
  /// The area of the surface that it represents.
  float area;
  /// The depth at which cells are about as large as the distance to the next samples.
  float depth;
  /// Of its cell at `kCodeDepth`, in Morton order.
  uint64_t code;
};

/// Depth of the codes. Limit: a code of three coordinates of 21 bits fits 64 bits.
constexpr int kCodeDepth = 21;

/// The cube in which a surface is reconstructed: world = origin + side × position.
struct Cube {
  std::array<double, 3> origin{};
  double side = 0;
};

/// The finite points with a normal, in Morton order.
struct Samples {
  Uninitialized<Sample> samples;
  Cube cube;

  /// `scale` is the side of the cube relative to the largest extent of the points, unless the side
  /// of `given` is above zero; then points outside that cube are ignored. Throws `Degenerate` if
  /// fewer than four are left, or all at one position.
  Samples(const Strided<float>& positions, const Strided<float>& normals, double scale,
          const Cube& given, const ck_control* control);

  /// The samples in a brick of a level: from `first` to before `second`.
  std::pair<size_t, size_t> range(uint64_t brick_code, int depth) const;

  /// Calls `body(cell)` for each cell of a level with samples of at least `least` depth among those
  /// from `first` to before `last`.
  template <typename Body>
  void for_cells(size_t first, size_t last, int depth, float least, Body&& body) const {
    uint64_t before = UINT64_MAX;
    for (size_t i = first; i < last; ++i) {
      const uint64_t cell = samples[i].code >> 3 * (kCodeDepth - depth);
      if (cell == before || samples[i].depth < least) continue;
      before = cell;
      body(from_morton(cell));
    }
  }

  /// The results of `body(first, last)` for consecutive parts of the samples, in their order.
  template <typename Body>
  auto map_blocks(const ck_control* control, Body&& body) const {
    // Samples of a part. Chosen: a few milliseconds; parts repeat the bricks at their ends.
    constexpr size_t kBlock = 1 << 15;
    const size_t count = samples.size();
    std::vector<decltype(body(size_t{0}, count))> results((count + kBlock - 1) / kBlock);
    parallel_for(control, results.size(), [&](size_t i) {
      results[i] = body(i * kBlock, std::min(count, (i + 1) * kBlock));
    });
    return results;
  }

 private:
  Cube cube_around(double scale) const;
  void remove_outside();
  void move_to_cube(Sample& sample) const;
  void sort(const ck_control* control);
};

/// The quadratic B-spline weights of the 27 nodes around a position.
class SplineWeights {
 public:
  /// Nodes are relative to the brick at `corner`, in bricks, of a level with `side` cells per axis.
  SplineWeights(const std::array<float, 3>& position, const Coordinates& corner, int side) {
    for (size_t a = 0; a < 3; ++a) {
      const double at = static_cast<double>(position[a]) * side, nearest = std::floor(at + 0.5);
      const double d = at - nearest;
      first_[a] = static_cast<int>(nearest) - 1 - kSide * corner[a];
      weights_[a] = {static_cast<float>(0.5 * (0.5 - d) * (0.5 - d)),
                     static_cast<float>(0.75 - d * d),
                     static_cast<float>(0.5 * (0.5 + d) * (0.5 + d))};
    }
  }

  Coordinates node(int n) const {
    return {first_[0] + n % 3, first_[1] + n / 3 % 3, first_[2] + n / 9};
  }
  float weight(int n) const {
    return weights_[0][n % 3] * weights_[1][n / 3 % 3] * weights_[2][n / 9];
  }

 private:
  Coordinates first_;
  std::array<std::array<float, 3>, 3> weights_;
};

}  // namespace ck::poisson
