#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "ck_camera.h"
#include "geometry/pose.h"
#include "geometry/vec.h"

namespace ck {

/// A view as a 3 × 4 projection matrix: homogeneous pixel coordinates are affine in the world.
struct Projection {
  double rows[3][4];
  /// The camera center in the world frame.
  Vec3 center;
  /// Rotation of `cameraFromWorld`, row-major.
  std::array<double, 9> rotation;

  explicit Projection(const ck_view& view) : rotation(rotation_rows(view.camera_from_world)) {
    const ck_camera& camera = view.camera;
    const ck_pose& pose = view.camera_from_world;
    const double* r = rotation.data();
    const double t[3] = {pose.tx, pose.ty, pose.tz};
    for (int c = 0; c < 4; ++c) {
      const auto entry = [&](int row) { return c < 3 ? r[3 * row + c] : t[row]; };
      rows[2][c] = entry(2);
      rows[0][c] = camera.fx * entry(0) + camera.cx * entry(2);
      rows[1][c] = camera.fy * entry(1) + camera.cy * entry(2);
    }
    center = {static_cast<float>(-(r[0] * t[0] + r[3] * t[1] + r[6] * t[2])),
              static_cast<float>(-(r[1] * t[0] + r[4] * t[1] + r[7] * t[2])),
              static_cast<float>(-(r[2] * t[0] + r[5] * t[1] + r[8] * t[2]))};
  }

  /// x and y in pixels times depth, and depth.
  Vec3 homogeneous(Vec3 p) const {
    const auto row = [&](int i) {
      return static_cast<float>(rows[i][0] * p.x + rows[i][1] * p.y + rows[i][2] * p.z +
                                rows[i][3]);
    };
    return {row(0), row(1), row(2)};
  }
};

/// Bilinear color at a pixel position (pixel centers at .5); the border is repeated.
inline Vec3 sample_rgb(const uint8_t* rgb, int width, int height, float x, float y) {
  x = std::clamp(x - 0.5f, 0.0f, static_cast<float>(width - 1));
  y = std::clamp(y - 0.5f, 0.0f, static_cast<float>(height - 1));
  const int x0 = std::min(static_cast<int>(x), std::max(0, width - 2));
  const int y0 = std::min(static_cast<int>(y), std::max(0, height - 2));
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const size_t right = width > 1 ? 3 : 0, down = height > 1 ? 3 * static_cast<size_t>(width) : 0;
  const uint8_t* p =
      rgb + 3 * (static_cast<size_t>(y0) * static_cast<size_t>(width) + static_cast<size_t>(x0));
  const auto channel = [&](size_t c) {
    const float top = p[c] + fx * static_cast<float>(p[right + c] - p[c]);
    const float bottom = p[down + c] + fx * static_cast<float>(p[down + right + c] - p[down + c]);
    return top + fy * (bottom - top);
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace ck
