#include "video/color.h"

#ifdef CK_HAS_FFMPEG
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/guard.h"
#include "video/transfer.h"

namespace ck {
namespace {

/// The samples of one component of a frame.
class Component {
 public:
  Component(const AVFrame& frame, const AVPixFmtDescriptor& format, int index)
      : layout_(format.comp[index]),
        is_big_endian_(format.flags & AV_PIX_FMT_FLAG_BE),
        data_(frame.data[layout_.plane] + layout_.offset),
        stride_(frame.linesize[layout_.plane]) {
    const bool is_chroma = !(format.flags & AV_PIX_FMT_FLAG_RGB) && (index == 1 || index == 2);
    x_shift_ = is_chroma ? format.log2_chroma_w : 0;
    y_shift_ = is_chroma ? format.log2_chroma_h : 0;
    width = AV_CEIL_RSHIFT(frame.width, x_shift_);
    height = AV_CEIL_RSHIFT(frame.height, y_shift_);
  }

  /// Size of the component's plane in samples.
  int width, height;

  int depth() const { return layout_.depth; }

  /// Writes the samples of row `y`.
  void read(int y, uint16_t* samples) const {
    const uint8_t* row = data_ + static_cast<ptrdiff_t>(y) * stride_;
    const unsigned mask = (1u << layout_.depth) - 1;
    if (layout_.depth + layout_.shift <= 8) {
      for (int x = 0; x < width; ++x) {
        samples[x] = static_cast<uint16_t>(row[x * layout_.step] >> layout_.shift & mask);
      }
      return;
    }
    for (int x = 0; x < width; ++x) {
      const uint8_t* p = row + x * layout_.step;
      const unsigned word = is_big_endian_ ? p[0] << 8 | p[1] : p[1] << 8 | p[0];
      samples[x] = static_cast<uint16_t>(word >> layout_.shift & mask);
    }
  }

  /// Interpolates linearly between the two rows nearest to row `y` of the frame, and between their
  /// samples; at even columns or rows if the samples lie there, else between the pixels.
  void upsample(int y, const AVFrame& frame, std::vector<uint16_t> rows[2],
                std::vector<float>& samples) const {
    const AVChromaLocation place = frame.chroma_location;
    const bool is_left =
        place != AVCHROMA_LOC_CENTER && place != AVCHROMA_LOC_TOP && place != AVCHROMA_LOC_BOTTOM;
    const bool is_top = place == AVCHROMA_LOC_TOPLEFT || place == AVCHROMA_LOC_TOP;
    const auto position = [](int pixel, int shift, bool is_cosited) {
      const float step = 1.0f / static_cast<float>(1 << shift);
      const auto p = static_cast<float>(pixel);
      return is_cosited ? p * step : (p + 0.5f) * step - 0.5f;
    };
    const float v = std::clamp(position(y, y_shift_, is_top), 0.0f, static_cast<float>(height - 1));
    const int above = static_cast<int>(v);
    read(above, rows[0].data());
    read(std::min(above + 1, height - 1), rows[1].data());
    const float down = v - static_cast<float>(above);
    for (int x = 0; x < frame.width; ++x) {
      const float u =
          std::clamp(position(x, x_shift_, is_left), 0.0f, static_cast<float>(width - 1));
      const int left = static_cast<int>(u), right = std::min(left + 1, width - 1);
      const float across = u - static_cast<float>(left);
      const auto mix = [&](const std::vector<uint16_t>& row) {
        const float a = row[left], b = row[right];
        return a + across * (b - a);
      };
      const float top = mix(rows[0]);
      samples[x] = top + down * (mix(rows[1]) - top);
    }
  }

 private:
  AVComponentDescriptor layout_;
  bool is_big_endian_;
  const uint8_t* data_;
  ptrdiff_t stride_;
  int x_shift_, y_shift_;
};

void require_readable(const AVPixFmtDescriptor& format) {
  constexpr uint64_t kOthers = AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BITSTREAM |
                               AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BAYER |
                               AV_PIX_FMT_FLAG_FLOAT;
  bool is_readable = !(format.flags & kOthers) && format.nb_components > 0;
  for (int c = 0; c < format.nb_components; ++c) {
    is_readable = is_readable && format.comp[c].depth <= 16;
  }
  if (!is_readable) {
    throw std::runtime_error(std::string("the pixel format ") + format.name +
                             " is not supported; convert it to H.264 or HEVC");
  }
}

/// The affine map of a sample to 0…1, or of chroma to -0.5…0.5 (ITU-T H.273, 8.3).
struct Range {
  float offset, scale;

  static Range of(const AVFrame& frame, const AVPixFmtDescriptor& format, int component) {
    const int depth = format.comp[component].depth;
    const bool is_rgb = format.flags & AV_PIX_FMT_FLAG_RGB;
    const bool is_chroma = !is_rgb && component > 0;
    const bool is_full = frame.color_range == AVCOL_RANGE_JPEG ||
                         std::strncmp(format.name, "yuvj", 4) == 0 ||
                         (is_rgb && frame.color_range != AVCOL_RANGE_MPEG);
    const auto unit = static_cast<float>(1 << (depth - 8));
    const auto largest = static_cast<float>((1 << depth) - 1);
    if (is_chroma) return {128 * unit, is_full ? 1 / largest : 1 / (224 * unit)};
    return is_full ? Range{0, 1 / largest} : Range{16 * unit, 1 / (219 * unit)};
  }

  float operator()(float sample) const { return (sample - offset) * scale; }
};

/// The weights of red and blue in the brightness (ITU-T H.273, table 4).
struct Matrix {
  float red, blue;

  static Matrix of(const AVFrame& frame) {
    switch (frame.colorspace) {
      case AVCOL_SPC_BT709:
        return {0.2126f, 0.0722f};
      case AVCOL_SPC_FCC:
        return {0.30f, 0.11f};
      case AVCOL_SPC_BT470BG:
      case AVCOL_SPC_SMPTE170M:
        return {0.299f, 0.114f};
      case AVCOL_SPC_SMPTE240M:
        return {0.212f, 0.087f};
      case AVCOL_SPC_BT2020_NCL:
      case AVCOL_SPC_BT2020_CL:
        return {0.2627f, 0.0593f};
      // What players assume if the stream doesn't say: high definition is BT.709.
      default:
        return frame.height < 720 ? Matrix{0.299f, 0.114f} : Matrix{0.2126f, 0.0722f};
    }
  }

  std::array<float, 3> rgb(float y, float cb, float cr) const {
    const float green = 1 - red - blue;
    const float r = y + 2 * (1 - red) * cr;
    const float b = y + 2 * (1 - blue) * cb;
    return {r, (y - red * r - blue * b) / green, b};
  }
};

}  // namespace

void average_brightness(const AVFrame& frame, const AVPixFmtDescriptor& format,
                        const ck_mutable_pixels& to) {
  require_readable(format);
  // Green stands for the brightness of RGB.
  const int index = format.flags & AV_PIX_FMT_FLAG_RGB ? 1 : 0;
  const Component component(frame, format, index);
  const Range range = Range::of(frame, format, index);
  std::vector<uint16_t> row(component.width);
  std::vector<uint64_t> sums(to.width);
  for (int64_t y = 0; y < to.height; ++y) {
    std::fill(sums.begin(), sums.end(), 0);
    const int64_t first = y * component.height / to.height;
    const int64_t last = std::max(first + 1, (y + 1) * component.height / to.height);
    const auto left = [&](int64_t x) { return x * component.width / to.width; };
    for (int64_t source = first; source < last; ++source) {
      component.read(static_cast<int>(source), row.data());
      for (int64_t x = 0; x < to.width; ++x) {
        for (int64_t i = left(x); i < std::max(left(x) + 1, left(x + 1)); ++i) sums[x] += row[i];
      }
    }
    for (int64_t x = 0; x < to.width; ++x) {
      const int64_t count = std::max<int64_t>(1, left(x + 1) - left(x)) * (last - first);
      const float mean = static_cast<float>(sums[x]) / static_cast<float>(count);
      to.data[y * to.width + x] =
          static_cast<uint8_t>(std::clamp(std::lround(255 * range(mean)), 0l, 255l));
    }
  }
}

void convert_to_srgb(const AVFrame& frame, const AVPixFmtDescriptor& format,
                     const ck_mutable_pixels& to) {
  require_readable(format);
  require(to.width == frame.width && to.height == frame.height && to.channels == 3,
          "the destination does not have the size of the frame");
  const bool is_rgb = format.flags & AV_PIX_FMT_FLAG_RGB;
  const bool is_gray = format.nb_components < 3;
  const Matrix matrix = Matrix::of(frame);
  const Transfer transfer(frame);
  std::vector<float> samples[3];
  std::vector<uint16_t> rows[2];
  for (auto& list : samples) list.resize(frame.width);
  for (auto& list : rows) list.resize(frame.width);
  for (int y = 0; y < frame.height; ++y) {
    for (int c = 0; c < (is_gray ? 1 : 3); ++c) {
      const Component component(frame, format, c);
      component.upsample(y, frame, rows, samples[c]);
      const Range range = Range::of(frame, format, c);
      for (float& sample : samples[c]) sample = range(sample);
    }
    uint8_t* out = to.data + static_cast<size_t>(y) * frame.width * 3;
    for (int x = 0; x < frame.width; ++x, out += 3) {
      const float a = samples[0][x];
      std::array<float, 3> rgb{a, a, a};
      if (is_rgb)
        rgb = {a, samples[1][x], samples[2][x]};
      else if (!is_gray)
        rgb = matrix.rgb(a, samples[1][x], samples[2][x]);
      transfer.encode(rgb, out);
    }
  }
}

}  // namespace ck
#endif
