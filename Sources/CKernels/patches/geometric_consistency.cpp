#include "patches/geometric_consistency.h"

#include <cmath>

#include "core/dispatch.h"

namespace ck::patches {
namespace {

/// Rows are evaluated in vectors of this many patches. Limit: the lanes of `F16`.
constexpr size_t kLanes = 16;

size_t padded(int width) { return (static_cast<size_t>(width) + kLanes - 1) / kLanes * kLanes; }

}  // namespace

RelativeProjection::RelativeProjection(const ck_patch_view& reference, const ck_patch_map& neighbor)
    : PixelTransfer(reference, neighbor.view, 1),
      magnification(static_cast<float>(neighbor.view.camera.fx / reference.camera.fx)),
      width(neighbor.view.camera.width),
      height(neighbor.view.camera.height),
      patches(neighbor.patches) {}

ConsistencyThresholds::ConsistencyThresholds(const ck_patch_view& reference,
                                             const ck_patch_filter_options& options)
    : fx(static_cast<float>(reference.camera.fx)),
      fy(static_cast<float>(reference.camera.fy)),
      cx(static_cast<float>(reference.camera.cx - 0.5)),
      cy(static_cast<float>(reference.camera.cy - 0.5)),
      cost(options.weak_texture_threshold),
      reprojection(options.reprojection_threshold),
      depth(options.depth_threshold),
      squared_cosine(options.normal_cosine * std::fabs(options.normal_cosine)),
      free_space(options.free_space_threshold) {}

PatchRow::PatchRow(int width)
    : width(width), w(padded(width), 0), gx(padded(width), 0), gy(padded(width), 0) {}

void PatchRow::read(const ck_patch* patches, int row, float cost_threshold) {
  y = row;
  const ck_patch* p = patches + static_cast<size_t>(row) * width;
  for (int x = 0; x < width; ++x) {
    w[x] = p[x].cost < cost_threshold ? p[x].inverse_depth : 0;
    gx[x] = p[x].gradient_x;
    gy[x] = p[x].gradient_y;
  }
}

ConsistencyRow::ConsistencyRow(int width)
    : kind(padded(width), kUnknown),
      cell(padded(width)),
      w(padded(width)),
      gx(padded(width)),
      gy(padded(width)),
      distance(padded(width)) {}

ConsistencyCheck consistency_check(ck_instructions instructions) {
  return dispatch(instructions, portable_consistency, avx2_consistency, avx512_consistency)
      .geometric_consistency;
}

}  // namespace ck::patches
