#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

namespace ck {

/// Three floats every `stride` bytes.
struct StridedPoints {
  const float* base;
  size_t stride;
  size_t count;

  const float* operator[](size_t index) const {
    return reinterpret_cast<const float*>(reinterpret_cast<const char*>(base) + index * stride);
  }

  bool is_finite(size_t index) const {
    const float* p = (*this)[index];
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  }
};

}  // namespace ck
