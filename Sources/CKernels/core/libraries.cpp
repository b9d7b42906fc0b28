// First: jpeglib.h needs it.
#include <cstdio>

#include <embree3/rtcore_config.h>
#include <gnu/libc-version.h>
#include <jpeglib.h>
#include <lcms2.h>
#include <libdeflate.h>
#include <libheif/heif.h>
#include <meshoptimizer.h>
#include <png.h>
#include <tiffio.h>
#include <webp/decode.h>
#include <xxhash.h>

#include <Eigen/Core>
#include <nanoflann.hpp>
#include <opencv2/core/version.hpp>
#include <string>

#include "ck_core.h"
#include "core/optional_libraries.h"

#define CK_TEXT(value) #value
#define CK_VALUE(macro) CK_TEXT(macro)

extern "C" {
// Defined by scripts/packaging/link.
extern const unsigned char photogrammetry_viewer[] __attribute__((weak));
extern const unsigned char photogrammetry_viewer_end[] __attribute__((weak));
}

namespace {

std::string numbers(int a, int b, int c) {
  return std::to_string(a) + "." + std::to_string(b) + "." + std::to_string(c);
}

/// "LIBTIFF, Version 4.5.0\n…" → "4.5.0"
std::string tiff_version() {
  const std::string text = TIFFGetVersion();
  const size_t begin = text.find_last_of(' ', text.find('\n')) + 1;
  return text.substr(begin, text.find('\n') - begin);
}

std::string make_list() {
  const int webp = WebPGetDecoderVersion();
  const int lcms = cmsGetEncodedCMMversion();
  std::string list;
  const auto add = [&](const char* name, const std::string& version) {
    list += std::string(name) + " " + version + "\n";
  };
  add("Eigen", numbers(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  add("Embree", RTC_VERSION_STRING);
  if (const std::string ffmpeg = ck::linked_ffmpeg_version(); !ffmpeg.empty()) {
    add("FFmpeg", ffmpeg);
  }
  add("glibc", gnu_get_libc_version());
  add("Little CMS", numbers(lcms / 1000, lcms % 1000 / 10, lcms % 10));
  add("libdeflate", LIBDEFLATE_VERSION_STRING);
  add("libheif", heif_get_version());
#ifdef LIBJPEG_TURBO_VERSION
  add("libjpeg-turbo", CK_VALUE(LIBJPEG_TURBO_VERSION));
#else
  add("libjpeg", CK_VALUE(JPEG_LIB_VERSION));
#endif
  add("libpng", png_get_libpng_ver(nullptr));
  if (const std::string raw = ck::raw_version(); !raw.empty()) add("LibRaw", raw);
  add("libtiff", tiff_version());
  add("libwebp", numbers(webp >> 16, webp >> 8 & 255, webp & 255));
  add("meshoptimizer", numbers(MESHOPTIMIZER_VERSION / 1000, MESHOPTIMIZER_VERSION % 1000 / 10,
                               MESHOPTIMIZER_VERSION % 10));
  add("nanoflann",
      numbers(NANOFLANN_VERSION >> 8, NANOFLANN_VERSION >> 4 & 15, NANOFLANN_VERSION & 15));
  add("OpenCV", CV_VERSION);
  if (const std::string exr = ck::exr_version(); !exr.empty()) add("OpenEXR", exr);
  add("xxHash", numbers(XXH_VERSION_MAJOR, XXH_VERSION_MINOR, XXH_VERSION_RELEASE));
  return list;
}

}  // namespace

const char* ck_library_versions(void) {
  static const std::string list = make_list();
  return list.c_str();
}

ck_span ck_viewer_bundle(void) {
  if (!photogrammetry_viewer) return {nullptr, 0, 1};
  return {photogrammetry_viewer,
          static_cast<size_t>(photogrammetry_viewer_end - photogrammetry_viewer), 1};
}
