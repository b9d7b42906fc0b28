#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/poisson/bricks.h"
#include "surface/poisson/samples.h"

namespace ck::poisson {

/// The samples of a cell, as one.
struct CellSample {
  uint16_t cell;
  /// Their area; a side of the cell is 1.
  float area;
  /// Their mean position in the cell, 0 to 1.
  std::array<float, 3> position;
};

/// One level of the octree. Its function is the trilinear interpolation of the values at its nodes.
struct Level {
  int depth = 0;
  BrickSet bricks;
  /// The cells that exist at this level, always all eight of a parent.
  std::vector<Mask> cells;
  /// The corners of these cells, at which the values are unknowns. The values around them follow
  /// from the level above.
  std::vector<Mask> nodes;
  /// For each brick that of the level above which contains it; empty for the first level.
  std::vector<int32_t> parents;
  /// The values, 512 per brick.
  std::vector<float> values;
  /// The right-hand side of the equations, 512 per brick, in units of the cube.
  std::vector<float> rhs;
  /// Samples by brick and cell, and where those of each brick start.
  std::vector<CellSample> samples;
  std::vector<uint32_t> offsets;

  /// Number of cells of the cube, per axis.
  int side() const { return 1 << depth; }
  /// Samples whose density suffices for this level, or for a part of it, are deeper.
  float least_depth() const { return std::nextafter(static_cast<float>(depth - 1), 100.0f); }
  /// The Morton code of a sample's cell.
  uint64_t cell_code(const Sample& sample) const { return sample.code >> 3 * (kCodeDepth - depth); }
  /// Whether a cell exists; its coordinates are relative to a brick, −8 to 15.
  bool has_cell(size_t brick, const Coordinates& at) const;
};

/// Levels down to this depth have all cells; the others, those around samples that are dense enough
/// for them. Chosen: the default of Kazhdan and Hoppe's program.
constexpr int kFullDepth = 5;
/// The first level. Chosen: its 125 nodes are solved well by the sweeps that it gets.
constexpr int kFirstDepth = 2;

/// Bytes of the solver and of its result for each brick of the octree, at most. Measured: 10.3 KB
/// at depth 11 and 14.6 KB with a few cells of depth 12 on spheres of 6 million points.
constexpr size_t kBytesPerBrick = 16 << 10;

/// The levels from `kFirstDepth` to at most `depth`, without values: those for which
/// `maximum_bytes` suffice, to whose depth `depth` is lowered, and those with all cells in any
/// case. They also have the cells of `base` around the samples.
std::vector<Level> make_levels(const Samples& samples, int& depth, size_t maximum_bytes,
                               const std::vector<Level>& base, const ck_control* control);

/// Finds the parents of a level's bricks.
void find_parents(Level& level, const Level& above, const ck_control* control);

/// Unmarks the cells some of whose corners are in no brick.
void drop_incomplete_cells(Level& level, const ck_control* control);

}  // namespace ck::poisson
