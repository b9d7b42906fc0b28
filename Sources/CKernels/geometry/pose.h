#pragma once

#include <array>

#include "ck_camera.h"

namespace ck {

/// The rotation of a pose as a row-major matrix; the quaternion must have unit length.
inline std::array<double, 9> rotation_rows(const ck_pose& pose) {
  // No fused multiply-add, so that the result is the same on every processor.
#pragma clang fp contract(off)
  const double x = pose.qx, y = pose.qy, z = pose.qz, w = pose.qw;
  return {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
          2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
          2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
}

}  // namespace ck
