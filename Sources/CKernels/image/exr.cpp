#include "image/exr.h"

#include "core/guard.h"
#include "core/optional_libraries.h"
#include "image/srgb_curve.h"

#ifdef PHOTOGRAMMETRY_WITHOUT_EXR

namespace ck {

void inspect_exr(const uint8_t*, size_t, ck_exr_info&) { throw LeftOut("OpenEXR"); }

void decode_exr(const uint8_t*, size_t, const ck_decode_limits&, ck_image&) {
  throw LeftOut("OpenEXR");
}

void decode_exr_alpha(const uint8_t*, size_t, const ck_decode_limits&, ck_image&) {
  throw LeftOut("OpenEXR");
}

void decode_exr_numbers(const uint8_t*, size_t, const ck_decode_limits&, ck_image&) {
  throw LeftOut("OpenEXR");
}

std::string exr_version() { return ""; }

}  // namespace ck

#else

#include <OpenEXR/openexr.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ck {
namespace {

/// A file in memory, as OpenEXR reads it.
struct Source {
  const uint8_t* bytes;
  uint64_t count;
};

int64_t read_bytes(exr_const_context_t, void* user, void* target, uint64_t count, uint64_t offset,
                   exr_stream_error_func_ptr_t) {
  const Source& file = *static_cast<const Source*>(user);
  const uint64_t read = std::min(count, file.count - std::min(offset, file.count));
  if (read > 0) std::memcpy(target, file.bytes + offset, read);
  return static_cast<int64_t>(read);
}

int64_t size(exr_const_context_t, void* user) {
  return static_cast<int64_t>(static_cast<const Source*>(user)->count);
}

/// The result says enough.
void ignore_error(exr_const_context_t, exr_result_t, const char*) {}

/// Throws the error that OpenEXR reports: `std::invalid_argument` if it doesn't read such files.
void check(exr_result_t result) {
  switch (result) {
    case EXR_ERR_SUCCESS:
      return;
    case EXR_ERR_OUT_OF_MEMORY:
      throw std::bad_alloc();
    case EXR_ERR_FEATURE_NOT_IMPLEMENTED:
      throw std::invalid_argument(exr_get_error_code_as_string(result));
    default:
      throw std::runtime_error(exr_get_error_code_as_string(result));
  }
}

/// A rectangle of pixels; the maxima are exclusive.
struct Window {
  int64_t left, top, right, bottom;

  explicit Window(const exr_attr_box2i_t& box)
      : left(box.min.x),
        top(box.min.y),
        right(int64_t{box.max.x} + 1),
        bottom(int64_t{box.max.y} + 1) {}

  int64_t width() const { return right - left; }
  int64_t height() const { return bottom - top; }
};

/// An open file; `bytes` must outlive it.
class File {
 public:
  File(const uint8_t* bytes, size_t count) : source_{bytes, count} {
    require(bytes && count > 0, "the file is empty");
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = ignore_error;
    how.user_data = &source_;
    how.read_fn = read_bytes;
    how.size_fn = size;
    check(exr_start_read(&context_, "image", &how));
  }
  ~File() { exr_finish(&context_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  exr_const_context_t get() const { return context_; }

  int parts() const {
    int parts = 0;
    check(exr_get_count(context_, &parts));
    return parts;
  }

  exr_storage_t storage() const {
    exr_storage_t storage{};
    check(exr_get_storage(context_, 0, &storage));
    return storage;
  }

  bool is_deep() const {
    return storage() != EXR_STORAGE_SCANLINE && storage() != EXR_STORAGE_TILED;
  }

  Window data_window() const {
    exr_attr_box2i_t box{};
    check(exr_get_data_window(context_, 0, &box));
    return Window(box);
  }

  Window display_window() const {
    exr_attr_box2i_t box{};
    check(exr_get_display_window(context_, 0, &box));
    return Window(box);
  }

  /// The names of the channels with a value for each pixel.
  std::vector<std::string> channels() const {
    const exr_attr_chlist_t* list = nullptr;
    check(exr_get_channels(context_, 0, &list));
    std::vector<std::string> names;
    for (int i = 0; i < list->num_channels; ++i) {
      const auto& channel = list->entries[i];
      if (channel.x_sampling == 1 && channel.y_sampling == 1) names.push_back(channel.name.str);
    }
    return names;
  }

  bool has(const std::string& channel) const {
    const auto names = channels();
    return std::find(names.begin(), names.end(), channel) != names.end();
  }

  /// Whether the file has a compression that OpenEXR 3.1 reads wrongly: B44 with other numbers than
  /// 16-bit ones, which mixes up their channels.
  bool is_misread() const {
    exr_compression_t compression{};
    check(exr_get_compression(context_, 0, &compression));
    if (compression != EXR_COMPRESSION_B44 && compression != EXR_COMPRESSION_B44A) return false;
    const exr_attr_chlist_t* list = nullptr;
    check(exr_get_channels(context_, 0, &list));
    return std::any_of(list->entries, list->entries + list->num_channels,
                       [](const auto& channel) { return channel.pixel_type != EXR_PIXEL_HALF; });
  }

  /// Throws unless this is one image within the limits whose pixels have one sample per channel.
  void require_decodable(const ck_decode_limits& limits) const {
    require(parts() == 1, "it has several parts");
    require(!is_deep(), "it is a deep image");
    require(!is_misread(), "its compression is unsupported");
    for (const Window& window : {data_window(), display_window()}) {
      require_within(limits, window.width(), window.height());
    }
  }

 private:
  Source source_;
  exr_context_t context_ = nullptr;
};

/// The decoder of one chunk after another.
struct Pipeline {
  explicit Pipeline(const File& file) : file(file) {}
  ~Pipeline() { exr_decoding_destroy(file.get(), &state); }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  const File& file;
  exr_decode_pipeline_t state = EXR_DECODE_PIPELINE_INITIALIZER;
  bool is_initialized = false;

  /// Decodes the channels `names` of a chunk, one plane after another, with the others behind them.
  void run(const exr_chunk_info_t& chunk, const std::vector<std::string>& names,
           std::vector<float>& planes) {
    if (is_initialized) {
      check(exr_decoding_update(file.get(), 0, &chunk, &state));
    } else {
      check(exr_decoding_initialize(file.get(), 0, &chunk, &state));
    }
    require(state.channel_count <= kMaximumChannels, "it has too many channels");
    planes.assign(place(chunk, names), 0);
    for (int16_t i = 0; i < state.channel_count; ++i) {
      state.channels[i].decode_to_ptr = reinterpret_cast<uint8_t*>(&planes[places[i]]);
    }
    if (!is_initialized) check(exr_decoding_choose_default_routines(file.get(), 0, &state));
    is_initialized = true;
    check(exr_decoding_run(file.get(), 0, &state));
  }

 private:
  /// Chosen: more than any renderer writes.
  static constexpr int16_t kMaximumChannels = 256;
  /// The index of the first value of each channel.
  std::array<size_t, kMaximumChannels> places{};

  /// Describes the planes of all channels and returns the number of their values. OpenEXR 3.1
  /// crashes with some layouts if a channel is to be skipped, so all are decoded.
  size_t place(const exr_chunk_info_t& chunk, const std::vector<std::string>& names) {
    const size_t plane = static_cast<size_t>(chunk.width) * static_cast<size_t>(chunk.height);
    size_t end = plane * names.size();
    for (int16_t i = 0; i < state.channel_count; ++i) {
      auto& channel = state.channels[i];
      const auto found = std::find(names.begin(), names.end(), channel.channel_name);
      if (found != names.end()) {
        require(channel.width == chunk.width && channel.height == chunk.height,
                "its channels differ in size");
        places[i] = plane * static_cast<size_t>(found - names.begin());
      } else {
        places[i] = end;
        // At least one value, so that there is an address.
        end += std::max<size_t>(
            1, static_cast<size_t>(channel.width) * static_cast<size_t>(channel.height));
      }
      channel.user_data_type = EXR_PIXEL_FLOAT;
      channel.user_bytes_per_element = sizeof(float);
      channel.user_pixel_stride = sizeof(float);
      channel.user_line_stride = static_cast<int32_t>(sizeof(float)) * channel.width;
    }
    return end;
  }
};

/// Calls `store(x, y, values)` for each pixel of the file, in coordinates of its windows; `values`
/// points to the first channel, the others follow at a distance of `stride`.
template <typename Store>
void for_each_pixel(const Window& data, const exr_chunk_info_t& chunk, int64_t left, int64_t top,
                    const std::vector<float>& planes, Store&& store) {
  const size_t stride = static_cast<size_t>(chunk.width) * static_cast<size_t>(chunk.height);
  for (int64_t y = 0; y < std::min<int64_t>(chunk.height, data.bottom - top); ++y) {
    for (int64_t x = 0; x < std::min<int64_t>(chunk.width, data.right - left); ++x) {
      store(left + x, top + y, &planes[static_cast<size_t>(y * chunk.width + x)], stride);
    }
  }
}

template <typename Store>
void read_lines(const File& file, const std::vector<std::string>& names, Store&& store) {
  const Window data = file.data_window();
  int32_t lines = 0;
  check(exr_get_scanlines_per_chunk(file.get(), 0, &lines));
  require(lines > 0, "it has no lines");
  Pipeline pipeline(file);
  std::vector<float> planes;
  for (int64_t y = data.top; y < data.bottom; y += lines) {
    exr_chunk_info_t chunk{};
    check(exr_read_scanline_chunk_info(file.get(), 0, static_cast<int>(y), &chunk));
    require(chunk.width == data.width() && chunk.height <= lines, "its lines have another length");
    pipeline.run(chunk, names, planes);
    for_each_pixel(data, chunk, data.left, y, planes, store);
  }
}

template <typename Store>
void read_tiles(const File& file, const std::vector<std::string>& names, Store&& store) {
  const Window data = file.data_window();
  int32_t width = 0, height = 0;
  check(exr_get_tile_sizes(file.get(), 0, 0, 0, &width, &height));
  require(width > 0 && height > 0, "its tiles have no pixels");
  Pipeline pipeline(file);
  std::vector<float> planes;
  for (int64_t row = 0; data.top + row * height < data.bottom; ++row) {
    for (int64_t column = 0; data.left + column * width < data.right; ++column) {
      exr_chunk_info_t chunk{};
      check(exr_read_tile_chunk_info(file.get(), 0, static_cast<int>(column), static_cast<int>(row),
                                     0, 0, &chunk));
      require(chunk.width <= width && chunk.height <= height, "its tiles have another size");
      pipeline.run(chunk, names, planes);
      for_each_pixel(data, chunk, data.left + column * width, data.top + row * height, planes,
                     store);
    }
  }
}

/// Calls `store(index, values, stride)` for the pixels inside the display window: `index` counts
/// them row by row, `values` points to the first of the channels `names`, the others follow at a
/// distance of `stride`.
template <typename Store>
void read(const File& file, const std::vector<std::string>& names, Store&& store) {
  const Window display = file.display_window();
  const auto place = [&](int64_t x, int64_t y, const float* values, size_t stride) {
    if (x < display.left || x >= display.right || y < display.top || y >= display.bottom) return;
    store(static_cast<size_t>((y - display.top) * display.width() + x - display.left), values,
          stride);
  };
  if (file.storage() == EXR_STORAGE_TILED) {
    read_tiles(file, names, place);
  } else {
    read_lines(file, names, place);
  }
}

/// Gives an image the size of the display window, with `channels` bytes per pixel, all zero.
void prepare(const File& file, const ck_decode_limits& limits, size_t channels, ck_image& image) {
  file.require_decodable(limits);
  const Window display = file.display_window();
  image.width = static_cast<int32_t>(display.width());
  image.height = static_cast<int32_t>(display.height());
  image.pixels.assign(static_cast<size_t>(display.width() * display.height()) * channels, 0);
}

/// XYZ from linear RGB, such that white has a luminance of 1.
Eigen::Matrix3d xyz_from_rgb(const exr_attr_chromaticities_t& c) {
  const auto xyz = [](double x, double y) { return Eigen::Vector3d(x / y, 1, (1 - x - y) / y); };
  Eigen::Matrix3d primaries;
  primaries << xyz(c.red_x, c.red_y), xyz(c.green_x, c.green_y), xyz(c.blue_x, c.blue_y);
  const Eigen::Vector3d scales = primaries.inverse() * xyz(c.white_x, c.white_y);
  return primaries * scales.asDiagonal();
}

/// Adapts colors from a white to another (Bradford: Lam, 1985).
Eigen::Matrix3d adaptation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Matrix3d cones;
  cones << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
  const Eigen::Vector3d ratio = (cones * to).cwiseQuotient(cones * from);
  return cones.inverse() * ratio.asDiagonal() * cones;
}

/// Limit: the primaries of sRGB and Rec. 709, which files without the attribute have.
constexpr exr_attr_chromaticities_t kRec709{0.64F, 0.33F, 0.30F,   0.60F,
                                            0.15F, 0.06F, 0.3127F, 0.3290F};

/// Linear sRGB from the colors of a file; nothing if they are equal, or if the file's primaries
/// make no sense.
std::optional<Eigen::Matrix3f> srgb_from_file(const File& file) {
  const exr_attribute_t* attribute = nullptr;
  if (exr_get_attribute_by_name(file.get(), 0, "chromaticities", &attribute) != EXR_ERR_SUCCESS ||
      !attribute || attribute->type != EXR_ATTR_CHROMATICITIES) {
    return std::nullopt;
  }
  const Eigen::Matrix3d own = xyz_from_rgb(*attribute->chromaticities);
  const Eigen::Matrix3d target = xyz_from_rgb(kRec709);
  const Eigen::Vector3d white = Eigen::Vector3d::Ones();
  const Eigen::Matrix3d matrix = target.inverse() * adaptation(own * white, target * white) * own;
  // Chosen: half of an 8-bit step; primaries of sRGB that are rounded to three digits change
  // nothing.
  constexpr double kNegligible = 2e-3;
  if (!matrix.allFinite() || matrix.isIdentity(kNegligible)) return std::nullopt;
  return matrix.cast<float>();
}

}  // namespace

void inspect_exr(const uint8_t* bytes, size_t count, ck_exr_info& info) {
  const File file(bytes, count);
  const Window display = file.display_window();
  constexpr int64_t kMaximum = std::numeric_limits<int32_t>::max();
  require(display.width() > 0 && display.height() > 0, "it has no pixels");
  info = {};
  info.width = static_cast<int32_t>(std::min(display.width(), kMaximum));
  info.height = static_cast<int32_t>(std::min(display.height(), kMaximum));
  info.parts = file.parts();
  info.is_deep = file.is_deep();
  info.has_alpha = file.has("A");
}

void decode_exr(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                ck_image& image) {
  const File file(bytes, count);
  prepare(file, limits, 3, image);
  const auto curve = std::make_unique<SRGBCurve>();
  if (file.has("R") && file.has("G") && file.has("B")) {
    const auto matrix = srgb_from_file(file);
    read(file, {"R", "G", "B"}, [&](size_t index, const float* values, size_t stride) {
      Eigen::Vector3f color(values[0], values[stride], values[2 * stride]);
      if (matrix) color = *matrix * color;
      for (int c = 0; c < 3; ++c) image.pixels[3 * index + c] = (*curve)(color[c]);
    });
    return;
  }
  require(file.has("Y"), "it has neither colors nor luminance");
  read(file, {"Y"}, [&](size_t index, const float* values, size_t) {
    std::memset(&image.pixels[3 * index], (*curve)(*values), 3);
  });
}

void decode_exr_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                      ck_image& image) {
  const File file(bytes, count);
  if (!file.has("A")) return;
  prepare(file, limits, 1, image);
  read(file, {"A"}, [&](size_t index, const float* values, size_t) {
    const float opacity = *values > 0 ? std::min(*values, 1.0F) : 0;
    image.pixels[index] = static_cast<uint8_t>(std::lround(255 * opacity));
  });
}

void decode_exr_numbers(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                        ck_image& image) {
  const File file(bytes, count);
  const auto names = file.channels();
  if (names.size() != 1) return;
  prepare(file, limits, sizeof(float), image);
  read(file, names, [&](size_t index, const float* values, size_t) {
    std::memcpy(&image.pixels[index * sizeof(float)], values, sizeof(float));
  });
}

std::string exr_version() {
  int major = 0, minor = 0, patch = 0;
  const char* extra = nullptr;
  exr_get_library_version(&major, &minor, &patch, &extra);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

}  // namespace ck

#endif

ck_status ck_exr_inspect(const uint8_t* bytes, size_t byte_count, ck_exr_info* info) {
  return ck::guarded([&] { ck::inspect_exr(bytes, byte_count, *info); });
}
