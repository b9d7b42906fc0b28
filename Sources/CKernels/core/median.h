#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ck {

/// The median of numbers, of which there must be at least one; of an even count the upper of the
/// two in the middle.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace ck
