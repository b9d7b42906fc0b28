#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace ck {

/// The transfer function of sRGB (IEC 61966-2-1) from linear light to 8-bit codes, as a table.
class SRGBCurve {
 public:
  SRGBCurve() {
    for (size_t i = 0; i < codes_.size(); ++i) {
      const double linear = static_cast<double>(i) / kSteps;
      const double encoded =
          linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
      codes_[i] = static_cast<uint8_t>(std::lround(255 * encoded));
    }
  }

  /// The code of a linear value, clipped to 0…1; 0 for NaN.
  uint8_t operator()(float linear) const {
    if (!(linear > 0)) return codes_.front();
    return linear < 1 ? codes_[static_cast<size_t>(linear * kSteps + 0.5F)] : codes_.back();
  }

 private:
  /// Entries of the table. Limit: the slope of the curve; where it is steepest, near black, a code
  /// has 20 entries.
  static constexpr int kSteps = 65535;
  std::array<uint8_t, kSteps + 1> codes_;
};

}  // namespace ck
