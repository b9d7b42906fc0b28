#pragma once

#include <string>

// Libraries that a program can be built without.

namespace ck {

/// The version of LibRaw; empty without the library.
std::string raw_version();

/// The version of OpenEXR; empty without the library.
std::string exr_version();

/// The version of FFmpeg; empty unless it is part of the program.
std::string linked_ffmpeg_version();

}  // namespace ck
