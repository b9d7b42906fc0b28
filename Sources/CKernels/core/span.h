#pragma once

#include <cmath>
#include <cstddef>

#include "ck_core.h"

namespace ck {

/// The elements of a span, each an array of numbers.
template <typename Scalar>
struct Strided {
  const char* base;
  size_t count, stride;

  Strided(const ck_span& span)
      : base(static_cast<const char*>(span.data)), count(span.count), stride(span.stride) {}
  Strided(const ck_mutable_span& span)
      : base(static_cast<const char*>(span.data)), count(span.count), stride(span.stride) {}

  const Scalar* operator[](size_t index) const {
    return reinterpret_cast<const Scalar*>(base + index * stride);
  }

  /// Whether the first three numbers of an element are finite.
  bool is_finite(size_t index) const {
    const Scalar* p = (*this)[index];
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  }
};

/// The elements of a span that a kernel writes to.
template <typename Scalar>
struct MutableStrided {
  char* base;
  size_t count, stride;

  MutableStrided(const ck_mutable_span& span)
      : base(static_cast<char*>(span.data)), count(span.count), stride(span.stride) {}

  Scalar* operator[](size_t index) const {
    return reinterpret_cast<Scalar*>(base + index * stride);
  }
};

}  // namespace ck
