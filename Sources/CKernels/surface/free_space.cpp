#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "core/span.h"

namespace {

/// The cells that the rays of one photo cross, as a bit set.
class CrossedCells {
 public:
  explicit CrossedCells(const ck_free_space_grid& grid) : grid_(grid) {
    const size_t cells = static_cast<size_t>(grid.size[0]) * grid.size[1] * grid.size[2];
    words_.assign((cells + 63) / 64, 0);
  }

  /// Marks the cells between `from` and the point at distance `clearance` before `to` (Amanatides
  /// and Woo, "A Fast Voxel Traversal Algorithm", Eurographics 1987).
  void cast(const float* from, const float* to, double clearance) {
    std::array<double, 3> start, direction;
    double length = 0;
    for (int i = 0; i < 3; ++i) {
      start[i] = (static_cast<double>(from[i]) - grid_.origin[i]) / grid_.cell_size;
      direction[i] = (static_cast<double>(to[i]) - from[i]) / grid_.cell_size;
      length += direction[i] * direction[i];
    }
    length = std::sqrt(length);
    // Ray parameter: 0 is the camera center, 1 the point.
    double enter = 0, leave = 1 - clearance / (grid_.cell_size * length);
    if (!std::isfinite(leave)) return;
    for (int i = 0; i < 3; ++i) clip(start[i], direction[i], grid_.size[i], enter, leave);
    if (enter < leave) walk(start, direction, enter, leave);
  }

  /// Increments the saturating counts of the marked cells.
  void add_to(uint8_t* counts) const {
    for (size_t w = 0; w < words_.size(); ++w) {
      for (uint64_t rest = words_[w]; rest; rest &= rest - 1) {
        uint8_t& count = counts[64 * w + static_cast<size_t>(__builtin_ctzll(rest))];
        if (count < UINT8_MAX) ++count;
      }
    }
  }

 private:
  /// Clips the ray to the grid along one axis.
  static void clip(double start, double direction, int size, double& enter, double& leave) {
    if (direction == 0) {
      if (start < 0 || start >= size) leave = enter;
      return;
    }
    const double a = -start / direction, b = (size - start) / direction;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }

  void walk(const std::array<double, 3>& start, const std::array<double, 3>& direction,
            double enter, double leave) {
    std::array<int, 3> cell, step;
    std::array<double, 3> next, span;
    for (int i = 0; i < 3; ++i) {
      const double at = start[i] + enter * direction[i];
      cell[i] = std::clamp(static_cast<int>(std::floor(at)), 0, grid_.size[i] - 1);
      step[i] = direction[i] < 0 ? -1 : 1;
      span[i] = direction[i] == 0 ? INFINITY : std::fabs(1 / direction[i]);
      next[i] = direction[i] == 0 ? INFINITY
                                  : (cell[i] + (step[i] > 0 ? 1 : 0) - start[i]) / direction[i];
    }
    for (;;) {
      mark(cell);
      const int axis =
          next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
      if (!(next[axis] < leave)) return;
      cell[axis] += step[axis];
      if (cell[axis] < 0 || cell[axis] >= grid_.size[axis]) return;
      next[axis] += span[axis];
    }
  }

  void mark(const std::array<int, 3>& cell) {
    const size_t index =
        (static_cast<size_t>(cell[2]) * grid_.size[1] + cell[1]) * grid_.size[0] + cell[0];
    words_[index / 64] |= uint64_t{1} << (index % 64);
  }

  const ck_free_space_grid& grid_;
  std::vector<uint64_t> words_;
};

/// The indices of the points that each photo sees.
std::vector<std::vector<uint32_t>> points_of_photos(const ck_seen_points& seen,
                                                    size_t photo_count) {
  std::vector<std::vector<uint32_t>> points(photo_count);
  for (size_t i = 0; i < seen.positions.count; ++i) {
    for (uint32_t k = seen.photo_offsets[i]; k < seen.photo_offsets[i + 1]; ++k) {
      ck::require(seen.photos[k] < photo_count, "a point refers to a photo that does not exist");
      points[seen.photos[k]].push_back(static_cast<uint32_t>(i));
    }
  }
  return points;
}

}  // namespace

ck_status ck_free_space(const ck_free_space_grid* grid, const ck_seen_points* points,
                        ck_span centers, const ck_control* control, uint8_t* counts) {
  return ck::guarded([&] {
    ck::require(grid && points && counts, "null pointer");
    ck::require(grid->cell_size > 0, "the cells need a size");
    size_t cells = 1;
    for (int size : grid->size) {
      ck::require(size > 0 && size <= 4096, "the grid must have 1 to 4096 cells per side");
      cells *= static_cast<size_t>(size);
    }
    std::fill(counts, counts + cells, 0);
    const ck::Strided<float> p(points->positions), from(centers);
    if (p.count == 0) return;
    ck::require(points->clearances && points->photo_offsets && points->photos && centers.data,
                "null pointer");
    const auto seen = points_of_photos(*points, centers.count);
    std::mutex mutex;
    ck::parallel_for(control, centers.count, [&](size_t photo) {
      CrossedCells crossed(*grid);
      for (uint32_t i : seen[photo]) crossed.cast(from[photo], p[i], points->clearances[i]);
      std::lock_guard<std::mutex> lock(mutex);
      crossed.add_to(counts);
    });
  });
}
