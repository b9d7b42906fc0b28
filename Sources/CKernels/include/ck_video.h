#ifndef CK_VIDEO_H
#define CK_VIDEO_H

#include "ck_image.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A video that is decoded from its beginning, one frame after the other. Free with
/// `ck_video_free`.
typedef struct ck_video ck_video;

/// Whether this program can read videos.
typedef enum {
  ck_video_supported = 0,
  /// The program was built without the headers of FFmpeg.
  ck_video_not_built = 1,
  /// The libraries of FFmpeg that the program was built for are not installed.
  ck_video_library_missing = 2,
} ck_video_support_t;

/// Properties of the first video stream of a file.
typedef struct {
  /// Size in pixels as decoded, before `rotation`.
  int32_t width, height;
  /// Quarter turns clockwise that rotate the frames upright, 0…3.
  int32_t rotation;
  /// Width of a pixel divided by its height.
  double pixel_aspect;
  /// Length in seconds, 0 if the file doesn't say.
  double seconds;
  /// Frames per second on average, 0 if the file doesn't say.
  double frame_rate;
} ck_video_info;

/// Tries to load the libraries of FFmpeg; thread-safe.
ck_video_support_t ck_video_support(void);

/// The version of FFmpeg's codecs; empty unless they are supported.
const char* ck_video_library_version(void);

/// Opens the file at `path`, UTF-8, with `threads` threads for decoding, on which the frames don't
/// depend. Frames larger than the limits are refused.
ck_status ck_video_open(const char* path, const ck_decode_limits* limits, int32_t threads,
                        ck_video** video, ck_video_info* info);

/// Decodes the next frame, whose presentation time in seconds is `seconds`; damaged frames are
/// passed over. `is_end` becomes true if there is none.
ck_status ck_video_next(ck_video* video, double* seconds, bool* is_end);

/// The brightness of the frame that `ck_video_next` decoded, as encoded and reduced to
/// `destination`, which is gray, by averaging.
ck_status ck_video_brightness(ck_video* video, const ck_mutable_pixels* destination);

/// The colors of the frame that `ck_video_next` decoded, as 8-bit sRGB of the size of the video.
///
/// Matrix, range, primaries and transfer function are those of the stream (ITU-T H.273). HDR (HLG
/// and PQ, ITU-R BT.2100) is mapped so that its reference white (ITU-R BT.2408) becomes white;
/// what is brighter is clipped.
ck_status ck_video_colors(ck_video* video, const ck_mutable_pixels* destination);

/// The metadata of the file or of its video stream under `key`, for example
/// `com.apple.quicktime.model`; null if there is none. Valid until the video is freed.
const char* ck_video_metadata(const ck_video* video, const char* key);

/// Frees the video; null does nothing.
void ck_video_free(ck_video* video);

#ifdef __cplusplus
}
#endif
#endif
