#include <cstddef>
#include <cstdint>
#include <vector>

#include "texture/atlas.h"

namespace ck::texture {
namespace {

/// A level of the image pyramid with its coverage.
struct Level {
  int side = 0;
  std::vector<uint8_t> pixels;
  std::vector<uint8_t> covered;
};

/// The next coarser level: averages of the covered pixels.
Level halved(const uint8_t* pixels, const std::vector<uint8_t>& covered, int side, int channels) {
  Level half;
  half.side = (side + 1) / 2;
  const size_t count = static_cast<size_t>(half.side) * static_cast<size_t>(half.side);
  const auto c_count = static_cast<size_t>(channels);
  half.pixels.assign(count * c_count, 0);
  half.covered.assign(count, 0);
  for (int y = 0; y < half.side; ++y) {
    for (int x = 0; x < half.side; ++x) {
      unsigned sums[3] = {0, 0, 0}, n = 0;
      for (int k = 0; k < 4; ++k) {
        const int sx = 2 * x + (k & 1), sy = 2 * y + (k >> 1);
        if (sx >= side || sy >= side) continue;
        const size_t s =
            static_cast<size_t>(sy) * static_cast<size_t>(side) + static_cast<size_t>(sx);
        if (!covered[s]) continue;
        for (size_t c = 0; c < c_count; ++c) sums[c] += pixels[s * c_count + c];
        ++n;
      }
      if (n == 0) continue;
      const size_t to =
          static_cast<size_t>(y) * static_cast<size_t>(half.side) + static_cast<size_t>(x);
      for (size_t c = 0; c < c_count; ++c) {
        half.pixels[to * c_count + c] = static_cast<uint8_t>((sums[c] + n / 2) / n);
      }
      half.covered[to] = 1;
    }
  }
  return half;
}

/// Fills the uncovered pixels from the next coarser level.
void fill_from(const Level& half, const std::vector<uint8_t>& covered, int side, int channels,
               uint8_t* pixels) {
  const auto c_count = static_cast<size_t>(channels);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const size_t to = static_cast<size_t>(y) * static_cast<size_t>(side) + static_cast<size_t>(x);
      if (covered[to]) continue;
      const size_t from =
          static_cast<size_t>(y / 2) * static_cast<size_t>(half.side) + static_cast<size_t>(x / 2);
      for (size_t c = 0; c < c_count; ++c) {
        pixels[to * c_count + c] = half.pixels[from * c_count + c];
      }
    }
  }
}

}  // namespace

void fill_uncovered(const std::vector<int32_t>& faces, int side, int channels,
                    const ck_control* control, uint8_t* pixels) {
  std::vector<uint8_t> covered(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) covered[i] = faces[i] >= 0;
  std::vector<Level> levels;
  levels.push_back(halved(pixels, covered, side, channels));
  while (levels.back().side > 1) {
    step(control, 0.5);
    const Level& last = levels.back();
    levels.push_back(halved(last.pixels.data(), last.covered, last.side, channels));
  }
  for (size_t i = levels.size() - 1; i > 0; --i) {
    Level& finer = levels[i - 1];
    fill_from(levels[i], finer.covered, finer.side, channels, finer.pixels.data());
  }
  fill_from(levels.front(), covered, side, channels, pixels);
}

}  // namespace ck::texture
