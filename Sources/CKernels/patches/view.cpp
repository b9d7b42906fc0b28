#include "patches/view.h"

#include <Eigen/Core>
#include <Eigen/LU>

namespace ck::patches {

Image half(const Image& image) {
  Image result;
  result.width = image.width / 2;
  result.height = image.height / 2;
  result.luma.resize(static_cast<size_t>(result.width) * result.height);
  for (int y = 0; y < result.height; ++y) {
    const uint8_t* upper = &image.luma[static_cast<size_t>(2 * y) * image.width];
    const uint8_t* lower = upper + image.width;
    uint8_t* out = &result.luma[static_cast<size_t>(y) * result.width];
    for (int x = 0; x < result.width; ++x) {
      const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
      out[x] = static_cast<uint8_t>((sum + 2) / 4);
    }
  }
  return result;
}

void pack(Image& image) {
  const int w = image.width, h = image.height;
  image.packed.assign(static_cast<size_t>(w) * h, 0);
  for (int y = 0; y + 1 < h; ++y) {
    const uint8_t* upper = &image.luma[static_cast<size_t>(y) * w];
    const uint8_t* lower = upper + w;
    uint32_t* out = &image.packed[static_cast<size_t>(y) * w];
    for (int x = 0; x + 1 < w; ++x) {
      out[x] =
          upper[x] | upper[x + 1] << 8 | lower[x] << 16 | static_cast<uint32_t>(lower[x + 1]) << 24;
    }
  }
}

namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Matrix calibration(const ck_patch_view& view, double scale) {
  Matrix k = Matrix::Identity();
  k(0, 0) = view.fx * scale;
  k(1, 1) = view.fy * scale;
  k(0, 2) = view.cx * scale;
  k(1, 2) = view.cy * scale;
  return k;
}

}  // namespace

void add_warp(Warps& warps, const ck_patch_view& reference, const ck_patch_view& source,
              double scale, const Image& image) {
  const Eigen::Map<const Matrix> r_ref(reference.rotation), r_src(source.rotation);
  const Eigen::Map<const Eigen::Vector3d> t_ref(reference.translation), t_src(source.translation);
  const Matrix rotation = r_src * r_ref.transpose();
  const Eigen::Vector3d translation = t_src - rotation * t_ref;
  const Matrix k_src = calibration(source, scale);
  const Matrix homography = k_src * rotation * calibration(reference, scale).inverse();
  const Eigen::Vector3d epipole = k_src * translation;
  // Pixel (0, 0) has its centre at (0.5, 0.5).
  const Eigen::Vector3d base = homography * Eigen::Vector3d(0.5, 0.5, 1);
  const int lane = warps.count++;
  for (int i = 0; i < 3; ++i) {
    warps.column0[i][lane] = static_cast<float>(homography(i, 0));
    warps.column1[i][lane] = static_cast<float>(homography(i, 1));
    warps.base[i][lane] = static_cast<float>(base(i));
    warps.epipole[i][lane] = static_cast<float>(epipole(i));
  }
  warps.limit_u[lane] = static_cast<float>(image.width) - 1.5f;
  warps.limit_v[lane] = static_cast<float>(image.height) - 1.5f;
  warps.stride[lane] = image.width;
  warps.packed[lane] = image.packed.data();
}

}  // namespace ck::patches
