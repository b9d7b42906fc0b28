#include <tiffio.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "core/guard.h"
#include "image/buffers.h"

namespace ck {
namespace {

/// A file in memory, as libtiff reads it, and the first error that it reports.
struct Source {
  const uint8_t* bytes;
  uint64_t count;
  uint64_t position = 0;
  std::string error;
};

Source& source(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* target, tmsize_t count) {
  Source& file = source(handle);
  const uint64_t left = file.count - std::min(file.position, file.count);
  const uint64_t read = std::min(left, static_cast<uint64_t>(std::max<tmsize_t>(count, 0)));
  std::memcpy(target, file.bytes + (file.count - left), read);
  file.position += read;
  return static_cast<tmsize_t>(read);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  Source& file = source(handle);
  const uint64_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.position : file.count;
  file.position = base + offset;
  return file.position;
}

int close(thandle_t) { return 0; }

toff_t size(thandle_t handle) { return source(handle).count; }

/// libtiff 4.5.0 does not read tiles without compression from a file that isn't mapped. It writes
/// to its own copies only.
int map(thandle_t handle, void** bytes, toff_t* count) {
  *bytes = const_cast<uint8_t*>(source(handle).bytes);
  *count = source(handle).count;
  return 1;
}

void unmap(thandle_t, void*, toff_t) {}

int on_error(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto& error = *static_cast<std::string*>(user);
  if (error.empty()) {
    char text[256];
    std::vsnprintf(text, sizeof text, format, arguments);
    error = text;
  }
  return 1;
}

/// Unknown tags and the like lose no pixels.
int on_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

/// An open file; its functions throw the error that libtiff reported.
class File {
 public:
  File(const uint8_t* bytes, size_t count, const ck_decode_limits& limits)
      : source_{bytes, count, 0, {}} {
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
        TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
    if (!options) throw std::bad_alloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &source_.error);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, nullptr);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), limits.maximum_pixels * kBytesOfPixel);
    file_.reset(TIFFClientOpenExt("image", "r", &source_, read_bytes, write_nothing, seek, close,
                                  size, map, unmap, options.get()));
    check(file_ != nullptr);
    require_within(limits, number<uint32_t>(TIFFTAG_IMAGEWIDTH),
                   number<uint32_t>(TIFFTAG_IMAGELENGTH));
  }

  TIFF* get() const { return file_.get(); }

  void check(bool succeeded) const {
    if (succeeded) return;
    throw std::runtime_error(source_.error.empty() ? "it can't be decoded" : source_.error);
  }

  /// The number in a field, or its default.
  template <typename T>
  T number(uint32_t tag) const {
    T value{};
    TIFFGetFieldDefaulted(file_.get(), tag, &value);
    return value;
  }

  int32_t width() const { return static_cast<int32_t>(number<uint32_t>(TIFFTAG_IMAGEWIDTH)); }
  int32_t height() const { return static_cast<int32_t>(number<uint32_t>(TIFFTAG_IMAGELENGTH)); }
  int orientation() const { return std::clamp<int>(number<uint16_t>(TIFFTAG_ORIENTATION), 1, 8); }

 private:
  /// Most bytes of a pixel in one buffer. Limit: four samples of 16 bits.
  static constexpr int64_t kBytesOfPixel = 8;

  Source source_;
  std::unique_ptr<TIFF, decltype(&TIFFClose)> file_{nullptr, TIFFClose};
};

/// Makes libtiff copy the colors of transparent pixels, which it multiplies by unassociated alpha.
void keep_colors_of_transparent_pixels(const File& file) {
  uint16_t count = 0, *types = nullptr;
  if (!TIFFGetField(file.get(), TIFFTAG_EXTRASAMPLES, &count, &types) || count == 0) return;
  std::vector<uint16_t> associated(types, types + count);
  std::replace(associated.begin(), associated.end(), static_cast<uint16_t>(EXTRASAMPLE_UNASSALPHA),
               static_cast<uint16_t>(EXTRASAMPLE_ASSOCALPHA));
  TIFFSetField(file.get(), TIFFTAG_EXTRASAMPLES, static_cast<int>(count), associated.data());
}

/// The pixels as stored, with four bytes each: red, green, blue and alpha.
struct RGBA {
  std::vector<uint32_t> pixels;
  bool has_alpha;
};

RGBA read_rgba(const File& file) {
  keep_colors_of_transparent_pixels(file);
  char message[1024] = "";
  TIFFRGBAImage image;
  require(TIFFRGBAImageOK(file.get(), message) != 0, message);
  file.check(TIFFRGBAImageBegin(&image, file.get(), /*stop_on_error=*/1, message) != 0);
  struct End {
    TIFFRGBAImage* image;
    ~End() { TIFFRGBAImageEnd(image); }
  } end{&image};
  image.req_orientation = image.orientation;
  RGBA result;
  result.has_alpha = image.alpha != 0;
  result.pixels.resize(size_t{image.width} * image.height);
  file.check(TIFFRGBAImageGet(&image, result.pixels.data(), image.width, image.height) != 0);
  return result;
}

/// Stores `pixels` of `channels` bytes each upright.
void store(const File& file, const std::vector<uint8_t>& pixels, int32_t channels,
           ck_image& image) {
  const int orientation = file.orientation();
  const auto [width, height] = std::pair(file.width(), file.height());
  image.width = orientation < 5 ? width : height;
  image.height = orientation < 5 ? height : width;
  image.pixels.resize(pixels.size());
  turn_upright({pixels.data(), width, height, channels, static_cast<size_t>(width) * channels},
               orientation, {image.pixels.data(), image.width, image.height, channels});
}

/// Reads rows or tiles of 32-bit numbers; `numbers` has the size of the image.
void read_numbers(const File& file, std::vector<uint8_t>& numbers) {
  const size_t row = static_cast<size_t>(file.width()) * sizeof(float);
  if (!TIFFIsTiled(file.get())) {
    require(TIFFScanlineSize64(file.get()) == row, "its rows have another length");
    for (int32_t y = 0; y < file.height(); ++y) {
      file.check(TIFFReadScanline(file.get(), &numbers[y * row], static_cast<uint32_t>(y), 0) > 0);
    }
    return;
  }
  const auto [width, height] = std::pair(file.number<uint32_t>(TIFFTAG_TILEWIDTH),
                                         file.number<uint32_t>(TIFFTAG_TILELENGTH));
  const size_t tile_row = size_t{width} * sizeof(float);
  require(width > 0 && height > 0 && TIFFTileSize64(file.get()) == tile_row * height,
          "its tiles have another size");
  std::vector<uint8_t> tile(tile_row * height);
  for (uint32_t y = 0; y < static_cast<uint32_t>(file.height()); y += height) {
    for (uint32_t x = 0; x < static_cast<uint32_t>(file.width()); x += width) {
      file.check(TIFFReadTile(file.get(), tile.data(), x, y, 0, 0) > 0);
      const size_t columns = std::min<size_t>(tile_row, row - x * sizeof(float));
      for (uint32_t i = 0; i < std::min<uint32_t>(height, file.height() - y); ++i) {
        std::memcpy(&numbers[(y + i) * row + x * sizeof(float)], &tile[i * tile_row], columns);
      }
    }
  }
}

}  // namespace

void decode_tiff(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                 ck_image& image) {
  const File file(bytes, count, limits);
  const RGBA stored = read_rgba(file);
  std::vector<uint8_t> rgb;
  rgb.reserve(stored.pixels.size() * 3);
  for (const uint32_t pixel : stored.pixels) {
    rgb.insert(rgb.end(),
               {static_cast<uint8_t>(TIFFGetR(pixel)), static_cast<uint8_t>(TIFFGetG(pixel)),
                static_cast<uint8_t>(TIFFGetB(pixel))});
  }
  store(file, rgb, 3, image);
}

void decode_tiff_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                       ck_image& image) {
  const File file(bytes, count, limits);
  const RGBA stored = read_rgba(file);
  if (!stored.has_alpha) return;
  std::vector<uint8_t> alpha;
  alpha.reserve(stored.pixels.size());
  for (const uint32_t pixel : stored.pixels) alpha.push_back(TIFFGetA(pixel));
  store(file, alpha, 1, image);
}

void decode_tiff_numbers(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                         ck_image& image) {
  const File file(bytes, count, limits);
  if (file.number<uint16_t>(TIFFTAG_BITSPERSAMPLE) != 8 * sizeof(float) ||
      file.number<uint16_t>(TIFFTAG_SAMPLESPERPIXEL) != 1 ||
      file.number<uint16_t>(TIFFTAG_SAMPLEFORMAT) != SAMPLEFORMAT_IEEEFP) {
    return;
  }
  std::vector<uint8_t> numbers(static_cast<size_t>(file.width()) * file.height() * sizeof(float));
  read_numbers(file, numbers);
  store(file, numbers, sizeof(float), image);
}

}  // namespace ck
