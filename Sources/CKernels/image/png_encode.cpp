#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include "core/guard.h"
#include "image/buffers.h"

namespace ck {
namespace {

/// Compression level of libdeflate. Chosen: higher levels take much more time for little gain in
/// size.
constexpr int kLevel = 5;
/// Number of filter types. Limit: PNG has no others.
constexpr size_t kFilters = 5;

/// The predictor of filter type 4 (Paeth).
uint8_t paeth(int left, int above, int corner) {
  const int estimate = left + above - corner;
  const int a = std::abs(estimate - left), b = std::abs(estimate - above);
  const int c = std::abs(estimate - corner);
  return static_cast<uint8_t>(a <= b && a <= c ? left : b <= c ? above : corner);
}

/// One row under each of the PNG filters.
class FilteredRow {
 public:
  FilteredRow(size_t size, size_t pixel) : size_(size), pixel_(pixel) {
    for (auto& bytes : filtered_) bytes.resize(size);
  }

  /// Writes the filter type and the filtered row with the smallest sum of absolute differences: the
  /// heuristic that the PNG specification recommends.
  void write(const uint8_t* row, const uint8_t* above, uint8_t* out) {
    filter(row, above);
    size_t best = 0;
    long lowest = sum(filtered_[0]);
    for (size_t i = 1; i < kFilters; ++i) {
      const long own = sum(filtered_[i]);
      if (own >= lowest) continue;
      lowest = own;
      best = i;
    }
    out[0] = static_cast<uint8_t>(best);
    std::memcpy(out + 1, filtered_[best].data(), size_);
  }

 private:
  void filter(const uint8_t* row, const uint8_t* above) {
    for (size_t i = 0; i < size_; ++i) {
      const int left = i < pixel_ ? 0 : row[i - pixel_];
      const int corner = i < pixel_ ? 0 : above[i - pixel_];
      filtered_[0][i] = row[i];
      filtered_[1][i] = static_cast<uint8_t>(row[i] - left);
      filtered_[2][i] = static_cast<uint8_t>(row[i] - above[i]);
      filtered_[3][i] = static_cast<uint8_t>(row[i] - (left + above[i]) / 2);
      filtered_[4][i] = static_cast<uint8_t>(row[i] - paeth(left, above[i], corner));
    }
  }

  static long sum(const std::vector<uint8_t>& bytes) {
    long result = 0;
    for (const uint8_t byte : bytes) result += std::abs(static_cast<int8_t>(byte));
    return result;
  }

  size_t size_, pixel_;
  std::array<std::vector<uint8_t>, kFilters> filtered_;
};

/// All rows, each preceded by its filter type.
std::vector<uint8_t> filtered(const uint8_t* pixels, size_t width, size_t height, size_t channels) {
  const size_t size = width * channels;
  std::vector<uint8_t> result((size + 1) * height);
  const std::vector<uint8_t> nothing(size, 0);
  FilteredRow row(size, channels);
  for (size_t y = 0; y < height; ++y) {
    const uint8_t* above = y == 0 ? nothing.data() : pixels + (y - 1) * size;
    row.write(pixels + y * size, above, result.data() + y * (size + 1));
  }
  return result;
}

/// The bytes as a zlib stream.
std::vector<uint8_t> compressed(const std::vector<uint8_t>& bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::vector<uint8_t> result(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  result.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                         result.data(), result.size()));
  require(!result.empty(), "the image can't be compressed");
  return result;
}

/// Appends a number, the most significant byte first.
void append(uint32_t number, std::vector<uint8_t>* file) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    file->push_back(static_cast<uint8_t>(number >> shift));
  }
}

void append_chunk(const char* name, const std::vector<uint8_t>& content,
                  std::vector<uint8_t>* file) {
  append(static_cast<uint32_t>(content.size()), file);
  const size_t start = file->size();
  file->insert(file->end(), name, name + 4);
  file->insert(file->end(), content.begin(), content.end());
  append(libdeflate_crc32(0, file->data() + start, file->size() - start), file);
}

}  // namespace

std::vector<uint8_t> encode_png(const uint8_t* pixels, int32_t width, int32_t height,
                                int32_t channels) {
  // Limit: codes of the format.
  constexpr uint8_t kBitDepth = 8, kGray = 0, kRGB = 2, kRGBA = 6;
  std::vector<uint8_t> header;
  append(static_cast<uint32_t>(width), &header);
  append(static_cast<uint32_t>(height), &header);
  const uint8_t colors = channels == 1 ? kGray : channels == 3 ? kRGB : kRGBA;
  header.insert(header.end(), {kBitDepth, colors, 0, 0, 0});
  const std::vector<uint8_t> data =
      compressed(filtered(pixels, static_cast<size_t>(width), static_cast<size_t>(height),
                          static_cast<size_t>(channels)));
  require(data.size() < size_t{1} << 31, "the image is too large for a PNG");
  std::vector<uint8_t> file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  append_chunk("IHDR", header, &file);
  append_chunk("IDAT", data, &file);
  append_chunk("IEND", {}, &file);
  return file;
}

}  // namespace ck
