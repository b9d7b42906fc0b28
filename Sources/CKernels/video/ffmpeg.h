#pragma once

// The functions of FFmpeg that the program calls.
//
// The libraries load a hundred others, which would slow down every start of the program: they are
// loaded with the first video, in the version whose headers the program was built with. A program
// that is linked statically calls them directly (PHOTOGRAMMETRY_LINKS_FFMPEG).

#if __has_include(<libavcodec/avcodec.h>) && __has_include(<libavformat/avformat.h>) && \
    !defined(PHOTOGRAMMETRY_WITHOUT_FFMPEG)
#define CK_HAS_FFMPEG 1

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/error.h>
#include <libavutil/log.h>
#include <libavutil/pixdesc.h>
}

namespace ck {

#define CK_FFMPEG_FORMAT(X)    \
  X(avformat_open_input)       \
  X(avformat_find_stream_info) \
  X(avformat_close_input)      \
  X(av_find_best_stream) X(av_guess_frame_rate) X(av_guess_sample_aspect_ratio) X(av_read_frame)
#define CK_FFMPEG_CODEC(X)         \
  X(avcodec_alloc_context3)        \
  X(avcodec_parameters_to_context) \
  X(avcodec_open2)                 \
  X(avcodec_send_packet)           \
  X(avcodec_receive_frame)         \
  X(avcodec_free_context) X(av_packet_alloc) X(av_packet_unref) X(av_packet_free)
#define CK_FFMPEG_UTILITIES(X) \
  X(av_frame_alloc)            \
  X(av_frame_free)             \
  X(av_dict_free)              \
  X(av_dict_get)               \
  X(av_dict_set)               \
  X(av_display_rotation_get)   \
  X(av_pix_fmt_desc_get) X(av_strerror) X(av_log_set_level) X(av_version_info)

/// Pointers to the functions, with their types in the headers.
struct FFmpeg {
#define CK_DECLARE(function) decltype(&::function) function = nullptr;
  CK_FFMPEG_FORMAT(CK_DECLARE)
  CK_FFMPEG_CODEC(CK_DECLARE)
  CK_FFMPEG_UTILITIES(CK_DECLARE)
#undef CK_DECLARE
};

/// The functions, loaded by the first call; null if the libraries are missing.
const FFmpeg* ffmpeg();

}  // namespace ck
#endif
