#pragma once

#include "video/ffmpeg.h"

#ifdef CK_HAS_FFMPEG
#include "ck_core.h"

namespace ck {

/// The brightness of a frame as encoded, averaged over the areas of the destination's pixels.
void average_brightness(const AVFrame& frame, const AVPixFmtDescriptor& format,
                        const ck_mutable_pixels& destination);

/// The colors of a frame as sRGB, in the size of the frame.
void convert_to_srgb(const AVFrame& frame, const AVPixFmtDescriptor& format,
                     const ck_mutable_pixels& destination);

}  // namespace ck
#endif
