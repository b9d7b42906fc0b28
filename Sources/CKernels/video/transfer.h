#pragma once

#include "video/ffmpeg.h"

#ifdef CK_HAS_FFMPEG
#include <array>
#include <vector>

namespace ck {

/// Converts the encoded colors of a stream to 8-bit sRGB.
///
/// Colors of standard dynamic range with the primaries of BT.709 stay as they are encoded, as
/// players show them.
class Transfer {
 public:
  explicit Transfer(const AVFrame& frame);

  /// Writes three bytes; `rgb` may exceed 0…1.
  void encode(const std::array<float, 3>& rgb, uint8_t* out) const;

 private:
  /// Light by encoded value, relative to the white of the result; empty if nothing is converted.
  std::vector<float> light_;
  /// Whether the light depends on the brightness of the scene (ITU-R BT.2100, table 5).
  bool is_hlg_ = false;
  /// To the primaries of BT.709.
  std::array<std::array<float, 3>, 3> primaries_;
};

}  // namespace ck
#endif
