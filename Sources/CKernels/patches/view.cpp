#include "patches/view.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cstdlib>

#include "core/halve.h"
#include "geometry/pose.h"

namespace ck::patches {

Image image_of(const ck_patch_view& view) {
  Image image;
  image.width = view.camera.width;
  image.height = view.camera.height;
  image.luma.assign(view.luma, view.luma + image.pixel_count());
  return image;
}

Image half(const Image& image) {
  Image result;
  result.width = image.width / 2;
  result.height = image.height / 2;
  result.luma.resize(result.pixel_count());
  halve(image.luma.data(), image.width, image.height, result.luma.data());
  return result;
}

void pack(uint32_t* texels, const Image& image) {
  const int w = image.width, h = image.height;
  for (int y = 0; y + 1 < h; ++y) {
    const uint8_t* upper = &image.luma[static_cast<size_t>(y) * w];
    const uint8_t* lower = upper + w;
    uint32_t* out = texels + static_cast<size_t>(y) * w;
    for (int x = 0; x + 1 < w; ++x) {
      out[x] =
          upper[x] | upper[x + 1] << 8 | lower[x] << 16 | static_cast<uint32_t>(lower[x + 1]) << 24;
    }
  }
}

namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// The camera matrix K of a view reduced to `scale` of its size.
Matrix calibration(const ck_patch_view& view, double scale) {
  Matrix k = Matrix::Identity();
  k(0, 0) = view.camera.fx * scale;
  k(1, 1) = view.camera.fy * scale;
  k(0, 2) = view.camera.cx * scale;
  k(1, 2) = view.camera.cy * scale;
  return k;
}

}  // namespace

PixelTransfer::PixelTransfer(const ck_patch_view& from, const ck_patch_view& to, double scale) {
  const ck_pose &from_world = from.camera_from_world, &to_world = to.camera_from_world;
  const std::array<double, 9> rows_from = rotation_rows(from_world);
  const std::array<double, 9> rows_to = rotation_rows(to_world);
  const Eigen::Map<const Matrix> r_from(rows_from.data()), r_to(rows_to.data());
  const Eigen::Vector3d t_from(from_world.tx, from_world.ty, from_world.tz);
  const Eigen::Vector3d t_to(to_world.tx, to_world.ty, to_world.tz);
  const Matrix rotation = r_to * r_from.transpose();
  const Eigen::Vector3d translation = t_to - rotation * t_from;
  const Matrix k_to = calibration(to, scale);
  const Matrix homography = k_to * rotation * calibration(from, scale).inverse();
  const Eigen::Vector3d shift = k_to * translation;
  // Pixel (0, 0) has its center at (0.5, 0.5).
  const Eigen::Vector3d origin = homography * Eigen::Vector3d(0.5, 0.5, 1);
  for (int i = 0; i < 3; ++i) {
    column0[i] = static_cast<float>(homography(i, 0));
    column1[i] = static_cast<float>(homography(i, 1));
    base[i] = static_cast<float>(origin(i));
    epipole[i] = static_cast<float>(shift(i));
  }
}

void add_source(Warps& warps, const ck_patch_view& reference, const ck_patch_view& source,
                double scale, const Image& image) {
  const PixelTransfer transfer(reference, source, scale);
  const int lane = warps.count++;
  for (int i = 0; i < 3; ++i) {
    warps.column0[i][lane] = transfer.column0[i];
    warps.column1[i][lane] = transfer.column1[i];
    warps.base[i][lane] = transfer.base[i];
    warps.epipole[i][lane] = transfer.epipole[i];
  }
  warps.limit_u[lane] = static_cast<float>(image.width) - 1.5f;
  warps.limit_v[lane] = static_cast<float>(image.height) - 1.5f;
  warps.stride[lane] = image.width;
  warps.offset[lane] = static_cast<int>(warps.texels.size());
  warps.texels.resize(warps.texels.size() + image.pixel_count());
  pack(warps.texels.data() + warps.offset[lane], image);
}

}  // namespace ck::patches

void ck_patches_halve(const uint8_t* luma, int32_t width, int32_t height, uint8_t* result) {
  ck::halve(luma, width, height, result);
}
