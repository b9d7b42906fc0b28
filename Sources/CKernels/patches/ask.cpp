#include "patches/ask.h"

#include <Eigen/Core>
#include <cmath>

#include "core/dispatch.h"

namespace ck::patches {
namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Matrix calibration(const ck_patch_view& view) {
  Matrix k;
  k << view.fx, 0, view.cx, 0, view.fy, view.cy, 0, 0, 1;
  return k;
}

/// Rows are asked in vectors of this many patches.
constexpr size_t kLanes = 16;

size_t padded(int width) { return (static_cast<size_t>(width) + kLanes - 1) / kLanes * kLanes; }

}  // namespace

Passage::Passage(const ck_patch_view& reference, const ck_patch_map& neighbor)
    : magnification(static_cast<float>(neighbor.view.fx / reference.fx)),
      width(neighbor.view.width),
      height(neighbor.view.height),
      patches(neighbor.patches) {
  const ck_patch_view& view = neighbor.view;
  const Eigen::Map<const Matrix> r_ref(reference.rotation), r_other(view.rotation);
  const Eigen::Map<const Eigen::Vector3d> t_ref(reference.translation), t_other(view.translation);
  const Matrix rotation = r_other * r_ref.transpose();
  const Eigen::Vector3d translation = t_other - rotation * t_ref;
  const double fx = reference.fx, fy = reference.fy;
  Matrix inverse;
  inverse << 1 / fx, 0, -reference.cx / fx, 0, 1 / fy, -reference.cy / fy, 0, 0, 1;
  const Matrix homography = calibration(view) * rotation * inverse;
  const Eigen::Vector3d shift = calibration(view) * translation;
  // Pixel (0, 0) has its centre at (0.5, 0.5).
  const Eigen::Vector3d origin = homography * Eigen::Vector3d(0.5, 0.5, 1);
  for (int i = 0; i < 3; ++i) {
    column0[i] = static_cast<float>(homography(i, 0));
    column1[i] = static_cast<float>(homography(i, 1));
    base[i] = static_cast<float>(origin(i));
    epipole[i] = static_cast<float>(shift(i));
  }
}

Agreement::Agreement(const ck_patch_view& reference, const ck_patch_filter_options& options)
    : fx(static_cast<float>(reference.fx)),
      fy(static_cast<float>(reference.fy)),
      cx(static_cast<float>(reference.cx - 0.5)),
      cy(static_cast<float>(reference.cy - 0.5)),
      cost(options.weak_texture_threshold),
      reprojection(options.reprojection_threshold),
      depth(options.depth_threshold),
      squared_cosine(options.normal_cosine * std::fabs(options.normal_cosine)),
      contradiction(options.contradiction_threshold) {}

Row::Row(int width)
    : width(width), w(padded(width), 0), gx(padded(width), 0), gy(padded(width), 0) {}

void Row::read(const ck_patch* patches, int row, float cost_threshold) {
  y = row;
  const ck_patch* p = patches + static_cast<size_t>(row) * width;
  for (int x = 0; x < width; ++x) {
    w[x] = p[x].cost < cost_threshold ? p[x].inverse_depth : 0;
    gx[x] = p[x].gradient_x;
    gy[x] = p[x].gradient_y;
  }
}

Replies::Replies(int width)
    : kind(padded(width), kNothing),
      cell(padded(width)),
      w(padded(width)),
      gx(padded(width)),
      gy(padded(width)),
      distance(padded(width)) {}

Ask ask_function(ck_instructions instructions) {
  return dispatch(instructions, portable_ask, avx2_ask, avx512_ask).ask;
}

}  // namespace ck::patches
