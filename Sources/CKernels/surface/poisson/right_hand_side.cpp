#include "surface/poisson/right_hand_side.h"

#include <algorithm>
#include <cmath>

#include "surface/poisson/field.h"
#include "surface/poisson/padded.h"
#include "surface/poisson/transfer.h"

namespace ck::poisson {

namespace {

/// Number of values that a thread adds at a time. Chosen: less than a millisecond.
constexpr size_t kBlock = 1 << 18;

/// A vector field whose values are those at the nodes, times the area of a cell's face.
using NormalField = Field<3>;

/// The normals of the samples of a level, times their areas. A sample between two depths is shared
/// by both.
NormalField splatted_normals(const Level& level, int finest, const Samples& samples,
                             const ck_control* control) {
  NormalField field(level.bricks);
  const float depth = static_cast<float>(level.depth), side = static_cast<float>(level.side());
  splat(field, level.bricks, samples, level.depth, control, [&](const Sample& s) {
    const bool is_deeper = level.depth == finest && s.depth > depth;
    const float share = is_deeper ? 1 : std::max(0.0f, 1 - std::fabs(s.depth - depth));
    const float length = share * s.area * side;
    return std::array<float, 3>{length * s.normal[0], length * s.normal[1], length * s.normal[2]};
  });
  return field;
}

/// Limit: integrals of two hat functions one node apart, the first before, equal to or after the
/// second: of their product, and of that of the second's derivative with the first.
constexpr float kMass[3] = {1.0f / 6, 2.0f / 3, 1.0f / 6};
constexpr float kDerivative[3] = {0.5f, 0, -0.5f};

/// Convolves along one axis; the outermost nodes of that axis are not set.
void convolve(const Padded& source, int axis, const float (&kernel)[3], Padded& result) {
  const size_t step = axis == 0 ? 1 : axis == 1 ? kPadded : kPadded * kPadded;
  int low[3] = {0, 0, 0}, high[3] = {kPadded, kPadded, kPadded};
  ++low[axis];
  --high[axis];
  for (int z = low[2]; z < high[2]; ++z) {
    for (int y = low[1]; y < high[1]; ++y) {
      for (size_t i = padded_index(low[0], y, z); i < padded_index(high[0], y, z); ++i) {
        result[i] =
            kernel[0] * source[i - step] + kernel[1] * source[i] + kernel[2] * source[i + step];
      }
    }
  }
}

/// Adds the integrals of the field with the gradients of the nodes' functions.
void add_integrals(const NormalField& field, Level& level, const ck_control* control) {
  parallel_for(control, level.bricks.count(), [&](size_t b) {
    Padded first{}, second{};
    float* rhs = level.rhs.data() + b * kBrick;
    for (int c = 0; c < 3; ++c) {
      gather(level.bricks, b, field.values.data() + c * kBrick, 3 * kBrick, level.side(),
             Beyond::zero, first);
      if (std::all_of(first.begin(), first.end(), [](float v) { return v == 0; })) continue;
      convolve(first, 0, c == 0 ? kDerivative : kMass, second);
      convolve(second, 1, c == 1 ? kDerivative : kMass, first);
      convolve(first, 2, c == 2 ? kDerivative : kMass, second);
      for_nodes(
          [&](int i, int x, int y, int z) { rhs[i] += second[padded_index(x + 1, y + 1, z + 1)]; });
    }
  });
}

/// The field of the level above at the nodes of a level, whose faces have a quarter of the area.
NormalField prolonged(const NormalField& field, const Level& above, const Level& level,
                      const ck_control* control) {
  NormalField result(level.bricks);
  parallel_for(control, level.bricks.count(), [&](size_t b) {
    for (int c = 0; c < 3; ++c) {
      float* values = result.channel(b, c);
      prolong(parent_values(above, level, b, field.values.data() + c * kBrick, 3 * kBrick), values);
      for (int i = 0; i < kBrick; ++i) values[i] /= 4;
    }
  });
  return result;
}

}  // namespace

void make_right_hand_sides(std::vector<Level>& levels, const Samples& samples,
                           const ck_control* control) {
  const int finest = levels.back().depth;
  const double steps = 2.0 * static_cast<double>(levels.size());
  for (Level& level : levels) level.rhs.assign(level.bricks.count() * kBrick, 0);
  // Each level's own samples and those of finer levels.
  for (size_t l = levels.size(); l-- > 0;) {
    const double done = static_cast<double>(levels.size() - 1 - l);
    const ProgressPart part(control, done / steps, (done + 1) / steps);
    add_integrals(splatted_normals(levels[l], finest, samples, part.control()), levels[l],
                  part.control());
    if (l > 0) restrict_rhs(levels[l], levels[l - 1], part.control());
  }
  // The samples of coarser levels, which lie among finer ones.
  const ProgressPart half(control, 0.5, 0.5);
  NormalField field = splatted_normals(levels[0], finest, samples, half.control());
  for (size_t l = 1; l < levels.size(); ++l) {
    const double done = static_cast<double>(levels.size() + l);
    const ProgressPart part(control, done / steps, (done + 1) / steps);
    NormalField finer = prolonged(field, levels[l - 1], levels[l], part.control());
    add_integrals(finer, levels[l], part.control());
    if (l + 1 == levels.size()) break;
    field = splatted_normals(levels[l], finest, samples, part.control());
    parallel_for_blocks(half.control(), finer.values.size(), kBlock,
                        [&](size_t i) { field.values[i] += finer.values[i]; });
  }
}

}  // namespace ck::poisson
