#include "video/transfer.h"

#ifdef CK_HAS_FFMPEG
#include <algorithm>
#include <cmath>

#include "image/srgb_curve.h"

namespace ck {
namespace {

/// Entries of the table of light: four per level of a stream of 10 bits. Chosen.
constexpr int kLevels = 4096;

using Rows = std::array<std::array<float, 3>, 3>;

constexpr Rows kSame = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
/// Limit: the inverse of the equation of ITU-R BT.2087 for BT.709 to BT.2020.
constexpr Rows kFromBT2020 = {
    {{1.6605f, -0.5876f, -0.0728f}, {-0.1246f, 1.1329f, -0.0083f}, {-0.0182f, -0.1006f, 1.1187f}}};
/// Limit: the chromaticities of Display P3 (SMPTE EG 432-1) and of BT.709, both with the white D65.
constexpr Rows kFromP3 = {
    {{1.2249f, -0.2247f, 0}, {-0.0421f, 1.0421f, 0}, {-0.0196f, -0.0786f, 1.0983f}}};

/// The inverse of hybrid log-gamma: light of the scene, 0…1.
double hlg(double value) {
  // Limit: ITU-R BT.2100, table 5.
  constexpr double a = 0.17883277, b = 1 - 4 * a, c = 0.55991073;
  return value <= 0.5 ? value * value / 3 : (std::exp((value - c) / a) + b) / 12;
}

/// The perceptual quantizer: light of the display in cd/m².
double pq(double value) {
  // Limit: ITU-R BT.2100, table 4.
  constexpr double m1 = 2610.0 / 16384, m2 = 2523.0 / 32;
  constexpr double c1 = 3424.0 / 4096, c2 = 2413.0 / 128, c3 = 2392.0 / 128;
  const double root = std::pow(value, 1 / m2);
  return 10000 * std::pow(std::max(root - c1, 0.0) / (c2 - c3 * root), 1 / m1);
}

/// The transfer function of sRGB (IEC 61966-2-1).
double srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Peak in cd/m² of the display that HLG is rendered for, the exponent of its system gamma, and
/// reference white in cd/m². Limit: ITU-R BT.2100 and, for white, BT.2408.
constexpr double kPeak = 1000, kSystemGamma = 1.2, kWhite = 203;

uint8_t rounded(float value, float largest) {
  return static_cast<uint8_t>(std::clamp(value * largest + 0.5f, 0.0f, largest));
}

}  // namespace

Transfer::Transfer(const AVFrame& frame) {
  const bool is_wide = frame.color_primaries == AVCOL_PRI_BT2020;
  const bool is_p3 = frame.color_primaries == AVCOL_PRI_SMPTE432;
  const bool is_pq = frame.color_trc == AVCOL_TRC_SMPTE2084;
  is_hlg_ = frame.color_trc == AVCOL_TRC_ARIB_STD_B67;
  primaries_ = is_wide ? kFromBT2020 : is_p3 ? kFromP3 : kSame;
  if (!is_hlg_ && !is_pq && !is_wide && !is_p3) return;
  light_.resize(kLevels);
  for (int i = 0; i < kLevels; ++i) {
    const double value = i / double{kLevels - 1};
    light_[i] = static_cast<float>(is_hlg_ ? hlg(value) : is_pq ? pq(value) / kWhite : srgb(value));
  }
}

void Transfer::encode(const std::array<float, 3>& rgb, uint8_t* out) const {
  if (light_.empty()) {
    for (int c = 0; c < 3; ++c) out[c] = rounded(rgb[c], 255);
    return;
  }
  std::array<float, 3> light;
  for (int c = 0; c < 3; ++c) {
    light[c] = light_[static_cast<size_t>(std::clamp(rgb[c], 0.0f, 1.0f) * (kLevels - 1) + 0.5f)];
  }
  if (is_hlg_) {
    // From the light of the scene to that of the display.
    const float brightness = 0.2627f * light[0] + 0.6780f * light[1] + 0.0593f * light[2];
    const float gain = static_cast<float>(kPeak / kWhite) *
                       std::pow(brightness, static_cast<float>(kSystemGamma - 1));
    for (float& value : light) value *= gain;
  }
  static const SRGBCurve curve;
  for (int c = 0; c < 3; ++c) {
    const auto& row = primaries_[c];
    out[c] = curve(row[0] * light[0] + row[1] * light[1] + row[2] * light[2]);
  }
}

}  // namespace ck
#endif
