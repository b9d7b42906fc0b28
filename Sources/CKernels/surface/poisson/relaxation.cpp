#include "surface/poisson/relaxation.h"

#include "surface/poisson/padded.h"

namespace ck::poisson {

namespace {

/// Limit: entries of the stiffness matrix of trilinear functions on cells of side 1: of a node with
/// itself, and with those across an edge and a corner. With nodes across a face they are zero.
constexpr float kDiagonal = 8.0f / 3, kEdge = -1.0f / 6, kCorner = -1.0f / 12;

/// The samples of the cells at a brick's nodes: nine cells per axis, which start at −1.
class NearbySamples {
 public:
  struct Entry {
    /// Of the cell's corners.
    std::array<float, 8> weights;
    /// Times the weight of the samples.
    float area;
  };

  NearbySamples(const Level& level, size_t brick) {
    numbers_.fill(-1);
    for (int k = 0; k < 8; ++k) {
      const Coordinates offset{-(k & 1), -(k >> 1 & 1), -(k >> 2)};
      const int32_t other = level.bricks.neighbor(brick, offset[0], offset[1], offset[2]);
      if (other < 0) continue;
      for (uint32_t i = level.offsets[other]; i < level.offsets[other + 1]; ++i) {
        add(level.samples[i], offset);
      }
    }
  }

  /// The samples of a cell; null if it has none.
  const Entry* find(int x, int y, int z) const {
    const int number = numbers_[index(x, y, z)];
    return number < 0 ? nullptr : &entries_[number];
  }

 private:
  static constexpr int kCells = kSide + 1;  // Limit: those at a brick's nodes.

  static size_t index(int x, int y, int z) {
    return static_cast<size_t>(((z + 1) * kCells + y + 1) * kCells + x + 1);
  }

  void add(const CellSample& s, const Coordinates& offset) {
    Coordinates at = local_coordinates(s.cell);
    for (size_t a = 0; a < 3; ++a) {
      at[a] += kSide * offset[a];
      if (at[a] < -1) return;
    }
    Entry entry{{}, kScreening * s.area};
    for (int k = 0; k < 8; ++k) {
      entry.weights[k] = (k & 1 ? s.position[0] : 1 - s.position[0]) *
                         (k >> 1 & 1 ? s.position[1] : 1 - s.position[1]) *
                         (k >> 2 ? s.position[2] : 1 - s.position[2]);
    }
    numbers_[index(at[0], at[1], at[2])] = static_cast<int16_t>(count_);
    entries_[count_++] = entry;
  }

  std::array<int16_t, kCells * kCells * kCells> numbers_;
  std::array<Entry, kCells * kCells * kCells> entries_;
  size_t count_ = 0;
};

/// Limit: offsets of a cell's corners from the first one in a padded brick.
constexpr size_t kCorners[8] = {padded_index(0, 0, 0), padded_index(1, 0, 0), padded_index(0, 1, 0),
                                padded_index(1, 1, 0), padded_index(0, 0, 1), padded_index(1, 0, 1),
                                padded_index(0, 1, 1), padded_index(1, 1, 1)};

/// Solves the equation of a node for its value.
void relax_node(Padded& values, int x, int y, int z, float rhs, const NearbySamples& near) {
  float* v = values.data() + padded_index(x + 1, y + 1, z + 1);
  constexpr int X = 1, Y = kPadded, Z = kPadded * kPadded;  // Limit: strides of a padded brick.
  const float edges = v[-X - Y] + v[X - Y] + v[-X + Y] + v[X + Y] + v[-X - Z] + v[X - Z] +
                      v[-X + Z] + v[X + Z] + v[-Y - Z] + v[Y - Z] + v[-Y + Z] + v[Y + Z];
  const float corners = v[-X - Y - Z] + v[X - Y - Z] + v[-X + Y - Z] + v[X + Y - Z] +
                        v[-X - Y + Z] + v[X - Y + Z] + v[-X + Y + Z] + v[X + Y + Z];
  float sum = rhs - kEdge * edges - kCorner * corners, diagonal = kDiagonal;
  for (int k = 0; k < 8; ++k) {
    // The node is corner k of this cell.
    const int cx = x - (k & 1), cy = y - (k >> 1 & 1), cz = z - (k >> 2);
    const NearbySamples::Entry* sample = near.find(cx, cy, cz);
    if (!sample) continue;
    const float* corner = values.data() + padded_index(cx + 1, cy + 1, cz + 1);
    float value = 0;
    for (int n = 0; n < 8; ++n) value += sample->weights[n] * corner[kCorners[n]];
    const float own = sample->weights[k];
    sum -= sample->area * own * (value - own * *v);
    diagonal += sample->area * own * own;
  }
  *v = sum / diagonal;
}

/// One sweep over the nodes of a brick.
void relax_brick(Level& level, size_t b) {
  Padded values;
  gather(level.bricks, b, level.values.data(), kBrick, level.side(), Beyond::mirrored, values);
  const NearbySamples near(level, b);
  const float side = static_cast<float>(level.side());
  const float* rhs = level.rhs.data() + b * kBrick;
  float* result = level.values.data() + b * kBrick;
  for_nodes([&](int i, int x, int y, int z) {
    if (level.nodes[b][i]) relax_node(values, x, y, z, side * rhs[i], near);
  });
  for_nodes(
      [&](int i, int x, int y, int z) { result[i] = values[padded_index(x + 1, y + 1, z + 1)]; });
}

}  // namespace

void relax(Level& level, int sweeps, const ck_control* control) {
  for (int k = 0; k < sweeps; ++k) {
    const ProgressPart part(control, static_cast<double>(k) / sweeps,
                            static_cast<double>(k + 1) / sweeps);
    // Bricks of one color have no neighboring nodes: their order is of no consequence.
    for_colors(level.bricks, 2, part.control(), [&](size_t b) {
      if (level.nodes[b].any()) relax_brick(level, b);
    });
  }
}

}  // namespace ck::poisson
