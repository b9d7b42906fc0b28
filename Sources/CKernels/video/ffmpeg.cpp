#include "video/ffmpeg.h"

#include "ck_video.h"
#include "core/optional_libraries.h"

#ifdef CK_HAS_FFMPEG
#include <optional>

#ifndef PHOTOGRAMMETRY_LINKS_FFMPEG
#include <dlfcn.h>

#include <string>
#endif

namespace ck {
namespace {

#ifdef PHOTOGRAMMETRY_LINKS_FFMPEG

std::optional<FFmpeg> load() {
  FFmpeg functions;
#define CK_LINK(function) functions.function = ::function;
  CK_FFMPEG_FORMAT(CK_LINK)
  CK_FFMPEG_CODEC(CK_LINK)
  CK_FFMPEG_UTILITIES(CK_LINK)
#undef CK_LINK
  return functions;
}

#else

/// The library of the version whose headers this file was compiled with: the structures of another
/// one differ. Stays loaded as long as the process runs.
void* library(const char* name, int version) {
  const std::string file = std::string("lib") + name + ".so." + std::to_string(version);
  return dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
}

template <typename Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

std::optional<FFmpeg> load() {
  void* const format = library("avformat", LIBAVFORMAT_VERSION_MAJOR);
  void* const codec = library("avcodec", LIBAVCODEC_VERSION_MAJOR);
  void* const utilities = library("avutil", LIBAVUTIL_VERSION_MAJOR);
  if (!format || !codec || !utilities) return std::nullopt;
  FFmpeg functions;
  bool is_complete = true;
#define CK_FIND(owner, function) \
  is_complete = is_complete && find(owner, #function, functions.function);
#define CK_FIND_FORMAT(function) CK_FIND(format, function)
#define CK_FIND_CODEC(function) CK_FIND(codec, function)
#define CK_FIND_UTILITY(function) CK_FIND(utilities, function)
  CK_FFMPEG_FORMAT(CK_FIND_FORMAT)
  CK_FFMPEG_CODEC(CK_FIND_CODEC)
  CK_FFMPEG_UTILITIES(CK_FIND_UTILITY)
  if (!is_complete) return std::nullopt;
  return functions;
}

#endif

}  // namespace

const FFmpeg* ffmpeg() {
  static const std::optional<FFmpeg> functions = [] {
    std::optional<FFmpeg> loaded = load();
    if (loaded) loaded->av_log_set_level(AV_LOG_QUIET);
    return loaded;
  }();
  return functions ? &*functions : nullptr;
}

}  // namespace ck

ck_video_support_t ck_video_support(void) {
  return ck::ffmpeg() ? ck_video_supported : ck_video_library_missing;
}

const char* ck_video_library_version(void) {
  const ck::FFmpeg* functions = ck::ffmpeg();
  return functions ? functions->av_version_info() : "";
}

#else

ck_video_support_t ck_video_support(void) { return ck_video_not_built; }

const char* ck_video_library_version(void) { return ""; }

#endif

std::string ck::linked_ffmpeg_version() {
#ifdef PHOTOGRAMMETRY_LINKS_FFMPEG
  return ck_video_library_version();
#else
  return "";
#endif
}
