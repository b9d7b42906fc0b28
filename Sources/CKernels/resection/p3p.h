#pragma once

#include <array>

#include "geometry/camera_model.h"

namespace ck {

/// All poses that project three points onto three unit rays; returns their number.
int p3p(const std::array<Vector3, 3>& rays, const std::array<Vector3, 3>& points,
        std::array<Pose, 4>& poses);

}  // namespace ck
