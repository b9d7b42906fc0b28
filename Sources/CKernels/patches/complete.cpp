#include <algorithm>
#include <cmath>
#include <vector>

#include "core/guard.h"
#include "patches/comparison.h"
#include "patches/geometric_consistency.h"
#include "patches/optimize.h"
#include "patches/smooth.h"

namespace ck::patches {
namespace {

/// Maps the patches of one view into another.
class PatchTransfer {
 public:
  PatchTransfer(const ck_patch_map& from, const ck_patch_map& to)
      : forward_(from.view, to), backward_(to.view, from) {}

  /// Computes the cell of the other view that shows a patch, and the patch's plane over that view's
  /// pixels; false if the patch is outside the view or back-facing.
  bool project(const ck_patch& p, int x, int y, int& cell_x, int& cell_y, Plane& plane) const {
    float q[3];
    for (int i = 0; i < 3; ++i) {
      q[i] = forward_.base[i] + x * forward_.column0[i] + y * forward_.column1[i] +
             p.inverse_depth * forward_.epipole[i];
    }
    if (!(q[2] > kMinimumProjection)) return false;
    const float u = q[0] / q[2], v = q[1] / q[2];
    if (!(u >= kMargin && v >= kMargin && u < forward_.width - kMargin &&
          v < forward_.height - kMargin)) {
      return false;
    }
    cell_x = static_cast<int>(u);
    cell_y = static_cast<int>(v);
    // Inverse depth is linear over the pixels of both views: differentiate the mapping from one to
    // the other, as in geometric_consistency.inl.
    const float at_x = x + 0.5f, at_y = y + 0.5f;
    const auto along = [&](const float* d) {
      return p.gradient_x * (d[0] - at_x * d[2]) + p.gradient_y * (d[1] - at_y * d[2]) +
             p.inverse_depth * d[2];
    };
    const float slope = 1 - along(backward_.epipole);
    if (!(slope > kMinimumRaySlope)) return false;
    plane.gx = along(backward_.column0) / slope;
    plane.gy = along(backward_.column1) / slope;
    plane.w = p.inverse_depth / q[2];
    plane = plane.at(cell_x + 0.5f - u, cell_y + 0.5f - v);
    return true;
  }

 private:
  RelativeProjection forward_, backward_;
};

/// The accepted patches of neighbors, mapped to the rejected cells of the reference; of several at
/// a cell, the nearest to the camera.
std::vector<Plane> proposals_from_neighbors(const ck_patch_map& reference,
                                            const ck_patch_map* neighbors, size_t count) {
  const size_t width = static_cast<size_t>(reference.view.camera.width);
  std::vector<Plane> proposals(width * reference.view.camera.height);
  for (size_t n = 0; n < count; ++n) {
    const ck_patch_map& neighbor = neighbors[n];
    const PatchTransfer transfer(neighbor, reference);
    for (int y = 0; y < neighbor.view.camera.height; ++y) {
      for (int x = 0; x < neighbor.view.camera.width; ++x) {
        const size_t from = static_cast<size_t>(y) * neighbor.view.camera.width + x;
        if (!neighbor.states[from]) continue;
        int to_x, to_y;
        Plane plane;
        if (!transfer.project(neighbor.patches[from], x, y, to_x, to_y, plane)) continue;
        const size_t to = to_y * width + to_x;
        if (!reference.states[to] && plane.w > proposals[to].w) proposals[to] = plane;
      }
    }
  }
  return proposals;
}

/// Propagates the accepted patches of a view into its rejected cells, and re-estimates those next
/// to depth discontinuities from the texels on their side of the edge.
class Completion {
 public:
  Completion(const ck_patch_map& reference, const Comparison& comparison,
             const std::vector<Plane>& proposals, const ck_patch_options& options)
      : comparison_(comparison),
        proposals_(proposals),
        steps_(options.refinement_steps),
        grid_(reference.view.camera.width, reference.view.camera.height),
        is_good_(grid_.planes.size()),
        is_edge_(grid_.planes.size()),
        optimizer_(grid_, comparison, kernels(options.instructions)) {
    grid_.read(reference.patches);
    for (size_t i = 0; i < is_good_.size(); ++i) is_good_[i] = reference.states[i] != 0;
    mark_edges();
  }

  /// Visits the rejected cells that have a proposal or an accepted cell before them in the sweep; a
  /// forward sweep also visits the accepted cells at edges.
  void sweep(bool is_forward, const ck_control* control, double from, double to) {
    const int back = is_forward ? -1 : 1;
    Wavefront(grid_.width, grid_.height, is_forward)
        .run(control, from, to, [&](Cell* cells, int count) {
          const auto end = std::remove_if(cells, cells + count, [&](const Cell& cell) {
            if (is_good(cell)) return !is_forward || !is_edge_[grid_.index(cell.x, cell.y)];
            const bool has_proposal = is_forward && proposals_[grid_.index(cell.x, cell.y)].w > 0;
            return !has_proposal && !is_good(cell, back, 0) && !is_good(cell, 0, back);
          });
          if (end > cells) visit(cells, static_cast<int>(end - cells), is_forward);
        });
  }

  Grid& grid() { return grid_; }

 private:
  /// The best patch found so far for a cell.
  struct BestPatch {
    Plane plane;
    float cost = kNoPatch;
    bool is_new = false;
  };

  bool is_good(const Cell& cell, int dx = 0, int dy = 0) const {
    return is_good_[grid_.index(cell.x + dx, cell.y + dy)] != 0;
  }

  Plane good_plane(const Cell& cell, int dx, int dy) const {
    return is_good(cell, dx, dy) ? grid_.plane_from(cell, dx, dy) : Plane();
  }

  void visit(const Cell* cells, int count, bool is_forward) {
    const int back = is_forward ? -1 : 1;
    BestPatch found[kWaveSize];
    for (int i = 0; i < count; ++i) {
      // A new patch must have a lower cost than a rejected patch, but not than an accepted one at
      // an edge: that was estimated from texels of both sides.
      if (!is_good(cells[i])) found[i].cost = grid_.costs[grid_.index(cells[i].x, cells[i].y)];
    }
    attempt(cells, count, found, [&](const Cell& cell) {
      if (is_good(cell)) return good_plane(cell, 0, 0);
      return is_forward ? proposals_[grid_.index(cell.x, cell.y)] : Plane();
    });
    attempt(cells, count, found, [&](const Cell& cell) { return good_plane(cell, back, 0); });
    attempt(cells, count, found, [&](const Cell& cell) { return good_plane(cell, 0, back); });
    for (int i = 0; i < count; ++i) {
      if (!found[i].is_new) continue;
      const size_t cell = grid_.index(cells[i].x, cells[i].y);
      grid_.planes[cell] = found[i].plane;
      grid_.costs[cell] = found[i].cost;
      is_good_[cell] = is_good_[cell] || found[i].cost < kWeakCost;
    }
  }

  /// Optimizes each cell's patch starting from the plane `propose(const Cell&)`, unless the current
  /// best one was obtained from there.
  template <typename Propose>
  void attempt(const Cell* cells, int count, BestPatch* found, const Propose& propose) {
    Cell tried[kWaveSize];
    Plane planes[kWaveSize];
    float support[kWaveSize][kTexels];
    BestPatch* results[kWaveSize];
    int n = 0;
    for (int i = 0; i < count; ++i) {
      planes[n] = propose(cells[i]);
      if (!(planes[n].w > 0)) continue;
      if (found[i].is_new && distance(found[i].plane, planes[n]) < kSamePlaneMotion) continue;
      weigh(cells[i], planes[n], support[n]);
      tried[n] = cells[i];
      results[n++] = &found[i];
    }
    optimizer_.start(tried, planes, support, n);
    optimizer_.refine(steps_, false);
    for (int i = 0; i < n; ++i) {
      const Candidate& pixel = optimizer_.begin()[i];
      if (pixel.cost < results[i]->cost) *results[i] = {pixel.plane, pixel.cost, true};
    }
  }

  /// Disparity between two planes at a pixel, in pixels of a source.
  float distance(const Plane& a, const Plane& b) const {
    return std::fabs(a.w - b.w) * comparison_.motion;
  }

  /// Marks the accepted cells with a depth discontinuity to an accepted cell two pixels away
  /// diagonally.
  void mark_edges() {
    // Chosen: no texel of a patch is farther away.
    constexpr int kNear[4][2] = {{-2, -2}, {2, -2}, {-2, 2}, {2, 2}};
    for (int y = kMargin; y < grid_.height - kMargin; ++y) {
      for (const auto& [dx, dy] : kNear) {
        for (int x = kMargin; x < grid_.width - kMargin; ++x) {
          const size_t here = grid_.index(x, y), there = grid_.index(x + dx, y + dy);
          const bool apart = are_discontinuous(grid_.planes[here], grid_.planes[there], dx, dy);
          is_edge_[here] |= is_good_[here] & is_good_[there] & apart;
        }
      }
    }
  }

  /// True if neither of two patches, (dx, dy) apart, continues the other. If only one of them does
  /// not, it is tilted by noise.
  bool are_discontinuous(const Plane& here, const Plane& there, int dx, int dy) const {
    const auto x = static_cast<float>(dx), y = static_cast<float>(dy);
    return distance(here.at(x, y), there) > kDiscontinuity &&
           distance(there.at(-x, -y), here) > kDiscontinuity;
  }

  /// Support weight of each texel of a patch: how likely it belongs to the same surface. Small
  /// where an accepted patch lies on another surface, 0.5 where no patch is accepted.
  void weigh(const Cell& at, const Plane& plane, float* weights) const {
    for (const int dy : kTexelOffsets) {
      for (const int dx : kTexelOffsets) {
        const size_t cell = grid_.index(at.x + dx, at.y + dy);
        const Plane there = plane.at(static_cast<float>(dx), static_cast<float>(dy));
        const float apart = distance(grid_.planes[cell], there) / kDiscontinuity;
        *weights++ = is_good_[cell] ? 1 / (1 + apart * apart * apart * apart) : kUnknownTexelWeight;
      }
    }
  }

  /// Disparity between patches of two different surfaces, in pixels of a source. Chosen: by trial.
  static constexpr float kDiscontinuity = 1;

  const Comparison& comparison_;
  const std::vector<Plane>& proposals_;
  const int steps_;
  Grid grid_;
  std::vector<uint8_t> is_good_;
  /// Accepted patches next to another surface, to be re-estimated.
  std::vector<uint8_t> is_edge_;
  PatchOptimizer optimizer_;
};

void complete(ck_patch* completed, const ck_patch_map& reference, const ck_patch_map* neighbors,
              size_t count, const ck_patch_options& options, const ck_control* control) {
  const auto proposals =
      proposals_from_neighbors(reference, neighbors, options.expands_across_views ? count : 0);
  InverseDepthRange range;
  for (size_t i = 0; i < proposals.size(); ++i) {
    range.include(proposals[i].w);
    if (reference.states[i]) range.include(reference.patches[i].inverse_depth);
  }
  if (range.is_empty()) {
    std::copy(reference.patches, reference.patches + proposals.size(), completed);
    return;
  }
  std::vector<ck_patch_view> sources;
  for (size_t i = 0; i < count; ++i) sources.push_back(neighbors[i].view);
  const Pyramids pyramids(reference.view, sources.data(), count, 1);
  const Comparison comparison = pyramids.compare(0, range, kCompletionRangeMargin, options);
  Completion completion(reference, comparison, proposals, options);
  completion.sweep(true, control, 0, 0.7);
  completion.sweep(false, control, 0.7, 1);
  smooth(completion.grid(), comparison);
  completion.grid().write(completed);
}

}  // namespace
}  // namespace ck::patches

ck_status ck_patches_complete(const ck_patch_map* reference, const ck_patch_map* neighbors,
                              size_t neighbor_count, const ck_patch_options* options,
                              const ck_control* control, ck_patch* completed) {
  return ck::guarded([&] {
    using namespace ck::patches;
    ck::require(completed && reference && reference->states && options &&
                    (neighbors || neighbor_count == 0),
                "missing argument");
    ck::require(neighbor_count <= kMaximumSources, "at most 8 neighbors");
    for (size_t i = 0; i < neighbor_count; ++i)
      ck::require(neighbors[i].states, "a neighbor has no filter states");
    complete(completed, *reference, neighbors, neighbor_count, *options, control);
  });
}
