#include "image/raw.h"

#include "core/guard.h"
#include "core/optional_libraries.h"

#ifdef PHOTOGRAMMETRY_WITHOUT_RAW

namespace ck {

void inspect_raw(const uint8_t*, size_t, ck_raw_info&) { throw LeftOut("LibRaw"); }

void decode_raw(const uint8_t*, size_t, const ck_decode_limits&, ck_image&) {
  throw LeftOut("LibRaw");
}

std::string raw_version() { return ""; }

}  // namespace ck

#else

#include <libraw/libraw.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <memory>
#include <new>

// Of OpenMP, which LibRaw uses; the compiler may come without its header.
extern "C" {
int omp_get_max_threads(void);
void omp_set_num_threads(int);
}

namespace ck {
namespace {

/// Keeps LibRaw on the calling thread: photos are decoded concurrently. The setting belongs to that
/// thread.
class OneThread {
 public:
  OneThread() : before_(omp_get_max_threads()) { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_;
};

/// Throws the error that LibRaw reports: `std::invalid_argument` if it doesn't read such files.
void check(int code) {
  switch (code) {
    case LIBRAW_SUCCESS:
      return;
    case LIBRAW_UNSUFFICIENT_MEMORY:
      throw std::bad_alloc();
    case LIBRAW_FILE_UNSUPPORTED:
    case LIBRAW_NOT_IMPLEMENTED:
    case LIBRAW_TOO_BIG:
      throw std::invalid_argument(libraw_strerror(code));
    default:
      throw std::runtime_error(libraw_strerror(code));
  }
}

void on_damage(void* data, const char*, const int) { *static_cast<bool*>(data) = true; }

/// An open file; `bytes` must outlive it.
class File {
 public:
  File(const uint8_t* bytes, size_t count) {
    require(bytes && count > 0, "the file is empty");
    raw_->set_dataerror_handler(on_damage, &is_damaged_);
    check(raw_->open_buffer(const_cast<uint8_t*>(bytes), count));
    const auto& sizes = raw_->imgdata.sizes;
    if (sizes.width == 0 || sizes.height == 0) throw std::runtime_error("its header is damaged");
  }

  LibRaw* operator->() const { return raw_.get(); }
  libraw_data_t& data() const { return raw_->imgdata; }

  /// Throws if pixels are missing or damaged.
  void check_pixels() const {
    if (is_damaged_) throw std::runtime_error("its pixel data is damaged or truncated");
  }

 private:
  OneThread one_thread_;
  // Hundreds of kilobytes, too large for the stack of a thread.
  std::unique_ptr<LibRaw> raw_ = std::make_unique<LibRaw>();
  bool is_damaged_ = false;
};

/// Copies text with its terminating zero, as much as fits.
template <size_t to, size_t from>
void copy_text(char (&target)[to], const char (&source)[from]) {
  const size_t count = std::min(strnlen(source, from), to - 1);
  std::memcpy(target, source, count);
  target[count] = 0;
}

/// A number, or 0 if it isn't finite.
double finite(double value) { return std::isfinite(value) ? value : 0; }

double degrees(const float (&parts)[3]) {
  return finite(double{parts[0]} + double{parts[1]} / 60 + double{parts[2]} / 3600);
}

void describe_place(const libraw_gps_info_t& gps, ck_raw_info& info) {
  // Without a direction, LibRaw has found no position.
  const bool has_directions =
      (gps.latref == 'N' || gps.latref == 'S') && (gps.longref == 'E' || gps.longref == 'W');
  info.has_position = gps.gpsparsed != 0 && has_directions;
  info.latitude = degrees(gps.latitude) * (gps.latref == 'S' ? -1 : 1);
  info.longitude = degrees(gps.longitude) * (gps.longref == 'W' ? -1 : 1);
  info.altitude = finite(double{gps.altitude}) * (gps.altref == 1 ? -1 : 1);
}

void describe(const libraw_data_t& data, ck_raw_info& info) {
  copy_text(info.make, data.idata.make);
  copy_text(info.model, data.idata.model);
  copy_text(info.lens, data.lens.Lens);
  copy_text(info.body_serial_number, data.shootinginfo.BodySerial);
  copy_text(info.lens_serial_number, data.lens.LensSerial);
  info.focal_length = finite(double{data.other.focal_len});
  info.focal_length_in_35mm_film = data.lens.FocalLengthIn35mmFormat;
  info.iso = finite(double{data.other.iso_speed});
  info.exposure_seconds = finite(double{data.other.shutter});
  // LibRaw takes the camera's clock for local time.
  std::tm time{};
  if (data.other.timestamp > 0 && localtime_r(&data.other.timestamp, &time)) {
    std::strftime(info.capture_time, sizeof info.capture_time, "%Y:%m:%d %H:%M:%S", &time);
  }
  describe_place(data.other.parsed_gps, info);
}

/// The EXIF orientation for LibRaw's flip: 1 swaps left and right, 2 top and bottom, 4 both axes.
int32_t orientation(int flip) {
  // Limit: codes of LibRaw and EXIF.
  constexpr int32_t kOrientations[] = {1, 2, 4, 3, 5, 8, 6, 7};
  return kOrientations[flip & 7];
}

/// Sets what must be equal for all photos of a set: exposure and curve depend on nothing in the
/// image. Only the white balance is the camera's.
void set_up(libraw_data_t& data) {
  auto& options = data.params;
  const auto& balance = data.color.cam_mul;
  options.use_camera_wb = balance[0] > 1e-5F && balance[2] > 1e-5F;  // Else that of daylight.
  options.use_auto_wb = 0;
  options.output_color = 1;  // sRGB
  options.output_bps = 8;
  options.gamm[0] = 1 / 2.4;  // The curve of sRGB
  options.gamm[1] = 12.92;
  options.no_auto_bright = 1;
  options.adjust_maximum_thr = 0;
  options.highlight = 0;  // Clipped
  options.user_qual = 3;  // AHD
}

/// Copies the image that LibRaw has made, gray as RGB.
void copy(const File& raw, const ck_decode_limits& limits, ck_image& image) {
  int width = 0, height = 0, colors = 0, bits = 0;
  raw->get_mem_image_format(&width, &height, &colors, &bits);
  require_within(limits, width, height);
  require(bits == 8 && (colors == 1 || colors == 3), "its number of colors is unsupported");
  image.width = width;
  image.height = height;
  const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
  image.pixels.resize(count * 3);
  check(raw->copy_mem_image(image.pixels.data(), width * colors, 0));
  if (colors == 1) {
    for (size_t i = count; i-- > 0;) std::memset(&image.pixels[3 * i], image.pixels[i], 3);
  }
}

}  // namespace

void inspect_raw(const uint8_t* bytes, size_t count, ck_raw_info& info) {
  const File raw(bytes, count);
  info = {};
  describe(raw.data(), info);
  info.orientation = orientation(raw.data().sizes.flip);
  check(raw->adjust_sizes_info_only());
  info.width = raw.data().sizes.iwidth;
  info.height = raw.data().sizes.iheight;
}

void decode_raw(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                ck_image& image) {
  const File raw(bytes, count);
  const auto& sizes = raw.data().sizes;
  require_within(limits, std::max(sizes.raw_width, sizes.width),
                 std::max(sizes.raw_height, sizes.height));
  check(raw->unpack());
  raw.check_pixels();
  set_up(raw.data());
  check(raw->dcraw_process());
  copy(raw, limits, image);
}

std::string raw_version() { return LibRaw::version(); }

}  // namespace ck

#endif

ck_status ck_raw_inspect(const uint8_t* bytes, size_t byte_count, ck_raw_info* info) {
  return ck::guarded([&] { ck::inspect_raw(bytes, byte_count, *info); });
}
