#include <algorithm>
#include <cstring>

#include "core/guard.h"
#include "image/buffers.h"

namespace ck {
namespace {

/// The header of a Windows bitmap (BITMAPINFOHEADER and its extensions).
struct Header {
  uint32_t pixel_offset, size, width, height;
  bool is_top_down;
  uint16_t bits;
  uint32_t palette_size;
};

// Limit: sizes in bytes of the format.
constexpr size_t kFileHeader = 14, kInfoHeader = 40, kMasks = 12;

/// Throws unless the file has all that its header specifies.
void require_complete(bool condition) {
  if (!condition) throw std::runtime_error("it is cut off");
}

/// A little-endian number in the header.
template <typename T>
T number(const uint8_t* bytes, size_t offset) {
  T value = 0;
  for (size_t i = 0; i < sizeof(T); ++i) value |= static_cast<T>(T{bytes[offset + i]} << (8 * i));
  return value;
}

Header read_header(const uint8_t* bytes, size_t count, const ck_decode_limits& limits) {
  constexpr uint32_t kUncompressed = 0, kBitFields = 3;  // Limit: codes of the format.
  require_complete(count >= kFileHeader + kInfoHeader);
  Header header{};
  header.pixel_offset = number<uint32_t>(bytes, 10);
  header.size = number<uint32_t>(bytes, 14);
  const auto height = static_cast<int32_t>(number<uint32_t>(bytes, 22));
  header.width = number<uint32_t>(bytes, 18);
  header.is_top_down = height < 0;
  header.height = static_cast<uint32_t>(height < 0 ? -int64_t{height} : int64_t{height});
  header.bits = number<uint16_t>(bytes, 28);
  header.palette_size = number<uint32_t>(bytes, 46);
  const auto compression = number<uint32_t>(bytes, 30);
  require(header.size >= kInfoHeader, "bitmaps of OS/2 aren't supported");
  require(header.bits == 8 || header.bits == 24 || header.bits == 32,
          "only bitmaps of 8, 24 and 32 bits are supported");
  require(compression == kUncompressed || (compression == kBitFields && header.bits == 32),
          "compressed bitmaps aren't supported");
  require_within(limits, header.width, header.height);
  if (compression == kBitFields) {
    require_complete(count >= kFileHeader + kInfoHeader + kMasks);
    require(number<uint32_t>(bytes, 54) == 0xFF0000 && number<uint32_t>(bytes, 58) == 0xFF00 &&
                number<uint32_t>(bytes, 62) == 0xFF,
            "another order of colors isn't supported");
  }
  return header;
}

}  // namespace

void decode_bmp(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                ck_image& image) {
  const Header header = read_header(bytes, count, limits);
  const size_t step = header.bits / 8;
  const size_t row = (header.width * step + 3) / 4 * 4;  // Rows are padded to four bytes.
  require_complete(header.pixel_offset <= count &&
                   (count - header.pixel_offset) / row >= header.height);
  // Four bytes for each color: blue, green, red and an unused one.
  uint8_t palette[256][4] = {};
  const size_t palette_start = kFileHeader + header.size;
  if (header.bits == 8 && palette_start < header.pixel_offset) {
    const size_t colors = header.palette_size == 0 ? 256 : header.palette_size;
    const size_t stored = (header.pixel_offset - palette_start) / 4;
    std::memcpy(palette, bytes + palette_start, 4 * std::min({colors, stored, size_t{256}}));
  }
  image.width = static_cast<int32_t>(header.width);
  image.height = static_cast<int32_t>(header.height);
  image.pixels.resize(size_t{header.width} * header.height * 3);
  uint8_t* target = image.pixels.data();
  for (uint32_t y = 0; y < header.height; ++y) {
    const size_t stored_row = header.is_top_down ? y : header.height - 1 - y;
    const uint8_t* source = bytes + header.pixel_offset + stored_row * row;
    for (uint32_t x = 0; x < header.width; ++x, target += 3) {
      const uint8_t* bgr = header.bits == 8 ? palette[source[x]] : source + x * step;
      target[0] = bgr[2];
      target[1] = bgr[1];
      target[2] = bgr[0];
    }
  }
}

}  // namespace ck
