#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "surface/poisson/bricks.h"
#include "surface/poisson/samples.h"

namespace ck::poisson {

/// A node relative to a brick, −8 to 15 per axis: its brick, −1 if there is none, and its index.
inline std::pair<int32_t, size_t> resolve(const BrickSet& bricks, size_t brick,
                                          const Coordinates& at) {
  return {bricks.neighbor(brick, at[0] >> 3, at[1] >> 3, at[2] >> 3), local_index(at)};
}

/// The corner `k` of eight, counted in binary, of a cell at `low`.
inline Coordinates corner(const Coordinates& low, int k) {
  return {low[0] + (k & 1), low[1] + (k >> 1 & 1), low[2] + (k >> 2)};
}

/// Vectors of `Channels` values at the nodes of a set of bricks; each brick has an array for each
/// channel.
template <int Channels>
struct Field {
  std::vector<float> values;

  explicit Field(const BrickSet& bricks) : values(bricks.count() * Channels * kBrick, 0.0f) {}

  float* channel(size_t brick, int c) { return values.data() + (brick * Channels + c) * kBrick; }
  const float* channel(size_t brick, int c) const {
    return const_cast<Field*>(this)->channel(brick, c);
  }
};

/// Where a position of the unit cube lies in a level.
struct CellPosition {
  /// Relative to a brick.
  Coordinates cell;
  /// In the cell, 0 to 1.
  std::array<double, 3> fraction;

  /// `corner` is the brick's, in bricks; `side` the number of cells per axis.
  CellPosition(const std::array<float, 3>& position, const Coordinates& corner, int side) {
    for (size_t a = 0; a < 3; ++a) {
      const double at = static_cast<double>(position[a]) * side;
      const int whole = std::min(static_cast<int>(at), side - 1);
      cell[a] = whole - kSide * corner[a];
      fraction[a] = at - whole;
    }
  }

  /// The weight of a corner in trilinear interpolation.
  double weight(int k) const {
    double weight = 1;
    for (size_t a = 0; a < 3; ++a) weight *= k >> a & 1 ? fraction[a] : 1 - fraction[a];
    return weight;
  }
};

/// The trilinear interpolation of values, 512 per brick, at a position in a cell of a brick.
inline double interpolate(const std::vector<float>& values, const BrickSet& bricks, size_t brick,
                          const CellPosition& position) {
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const auto [other, index] = resolve(bricks, brick, corner(position.cell, k));
    if (other >= 0) sum += position.weight(k) * values[other * size_t{kBrick} + index];
  }
  return sum;
}

/// Adds the samples' values to the nodes around them, with quadratic B-spline weights.
///
/// Bricks of one color are three apart, so that no two write to the same nodes: the order of the
/// additions does not depend on the threads.
template <int Channels, typename Value>
void splat(Field<Channels>& field, const BrickSet& bricks, const Samples& samples, int depth,
           const ck_control* control, Value&& value) {
  const auto add = [&](size_t brick) {
    const auto [first, last] = samples.range(bricks.code(brick), depth);
    for (size_t i = first; i < last; ++i) {
      const Sample& s = samples.samples[i];
      const std::array<float, Channels> added = value(s);
      if (added == std::array<float, Channels>{}) continue;
      const SplineWeights weights(s.position, bricks.coordinates(brick), 1 << depth);
      for (int n = 0; n < 27; ++n) {
        const auto [other, index] = resolve(bricks, brick, weights.node(n));
        if (other < 0) continue;
        for (int c = 0; c < Channels; ++c) {
          field.channel(other, c)[index] += weights.weight(n) * added[c];
        }
      }
    }
  };
  for_colors(bricks, 3, control, add, samples.samples.size() / std::max<size_t>(1, bricks.count()));
}

}  // namespace ck::poisson
