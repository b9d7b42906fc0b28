#pragma once

#include <string>

// Libraries that a program can be built without.

namespace ck {

/// The version of LibRaw; empty without the library.
std::string raw_version();

}  // namespace ck
